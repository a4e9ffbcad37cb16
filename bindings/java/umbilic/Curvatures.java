package umbilic;

import java.nio.ByteBuffer;
import java.nio.DoubleBuffer;

/** Curvatures of vertices; directions have x y z of each. */
public final class Curvatures {
  public final DoubleBuffer k1;
  public final DoubleBuffer k2;
  public final DoubleBuffer direction1;
  public final DoubleBuffer direction2;
  public final DoubleBuffer mean;
  public final DoubleBuffer gaussian;

  /** UMB_VERTEX_ bits. */
  public final ByteBuffer status;

  Curvatures(int vertices) {
    k1 = Buffers.doubles(vertices);
    k2 = Buffers.doubles(vertices);
    direction1 = Buffers.vectors(vertices);
    direction2 = Buffers.vectors(vertices);
    mean = Buffers.doubles(vertices);
    gaussian = Buffers.doubles(vertices);
    status = Buffers.bytes(vertices);
  }
}
