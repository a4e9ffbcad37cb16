package umbilic;

import java.nio.ByteBuffer;
import java.nio.DoubleBuffer;

/** Vertex normals. */
public final class Normals {
  /** Unit vectors, x y z of each vertex. */
  public final DoubleBuffer normal;

  /** UMB_VERTEX_ bits. */
  public final ByteBuffer status;

  Normals(int vertices) {
    normal = Buffers.vectors(vertices);
    status = Buffers.bytes(vertices);
  }
}
