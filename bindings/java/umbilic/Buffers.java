package umbilic;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.DoubleBuffer;
import java.nio.IntBuffer;

/** Buffers outside the Java heap, which C reads and writes where they are. */
public final class Buffers {
  private Buffers() {}

  /** What vertices have three of. */
  static DoubleBuffer vectors(int count) {
    return doubles(Math.multiplyExact(count, 3));
  }

  public static DoubleBuffer doubles(int count) {
    return bytes(Math.multiplyExact(count, Double.BYTES)).asDoubleBuffer();
  }

  public static IntBuffer integers(int count) {
    return bytes(Math.multiplyExact(count, Integer.BYTES)).asIntBuffer();
  }

  public static ByteBuffer bytes(int count) {
    return ByteBuffer.allocateDirect(count).order(ByteOrder.nativeOrder());
  }

  /** What remains of a buffer: itself if it is direct and in the machine's byte order, else a copy. */
  static DoubleBuffer direct(DoubleBuffer buffer) {
    if (buffer.isDirect() && buffer.order() == ByteOrder.nativeOrder()) return buffer.slice();
    return doubles(buffer.remaining()).put(buffer.duplicate()).rewind();
  }

  /** Likewise. */
  static IntBuffer direct(IntBuffer buffer) {
    if (buffer.isDirect() && buffer.order() == ByteOrder.nativeOrder()) return buffer.slice();
    return integers(buffer.remaining()).put(buffer.duplicate()).rewind();
  }
}
