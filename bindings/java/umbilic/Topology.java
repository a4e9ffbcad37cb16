package umbilic;

import com.sun.jna.Pointer;
import com.sun.jna.ptr.PointerByReference;
import java.lang.ref.Cleaner;
import java.lang.ref.Reference;
import java.nio.DoubleBuffer;
import java.nio.IntBuffer;
import java.util.concurrent.locks.ReadWriteLock;
import java.util.concurrent.locks.ReentrantReadWriteLock;

/**
 * The one-rings of a mesh, built once from its faces and used while positions move, by many threads at once if need be.
 *
 * <pre>
 * try (var mesh = new Topology(indices, null, vertexCount)) { // IntBuffer, triangles
 *   Curvatures found = mesh.curvatures(positions); // DoubleBuffer, x y z of each vertex
 * }
 * </pre>
 *
 * Buffers are read from their position to their limit, and not kept. What the library refuses throws {@link UmbilicException}.
 */
public final class Topology implements AutoCloseable {
  private static final Cleaner CLEANER = Cleaner.create();

  /** The memory, apart from the object that a cleaner waits to be forgotten. */
  private static final class Handle implements Runnable {
    private Pointer pointer;

    @Override
    public void run() {
      Native.LIBRARY.umb_topology_destroy(pointer);
      pointer = null;
    }
  }

  private final Handle handle = new Handle();
  private final Cleaner.Cleanable cleanable;
  private final ReadWriteLock lock = new ReentrantReadWriteLock(); // calls hold it for reading, so that close waits for them

  public Topology(IntBuffer indices, IntBuffer offsets, int vertexCount) {
    this(indices, offsets, vertexCount, 0);
  }

  /**
   * @param indices the vertices of all faces, one face after the other, from 0
   * @param offsets where each face starts, and the end of the last; null for triangles
   * @param threads 0 for as many as pay
   */
  public Topology(IntBuffer indices, IntBuffer offsets, int vertexCount, int threads) {
    var faces = new Native.Faces();
    faces.indices = Buffers.direct(indices);
    faces.index_count = faces.indices.remaining();
    if (offsets != null) {
      faces.offsets = Buffers.direct(offsets);
      faces.face_count = faces.offsets.remaining() - 1;
    }
    var options = new Native.TopologyOptions();
    options.threads = threads;
    var topology = new PointerByReference();
    var error = new Native.Error();
    Native.check(Native.LIBRARY.umb_topology_create(faces, vertexCount, options, topology, error), error);
    handle.pointer = topology.getValue();
    cleanable = CLEANER.register(this, handle);
  }

  /** Frees the topology, once calls that use it have returned; calls that follow throw. */
  @Override
  public void close() {
    lock.writeLock().lock();
    try {
      cleanable.clean();
    } finally {
      lock.writeLock().unlock();
    }
  }

  public Normals vertexNormals(DoubleBuffer positions) {
    return vertexNormals(positions, 0);
  }

  /** Unit normals (N_CM). */
  public Normals vertexNormals(DoubleBuffer positions, int threads) {
    lock.readLock().lock();
    try {
      var normals = new Normals(vertexCount());
      var options = new Native.NormalOptions();
      options.run.threads = threads;
      var outputs = new Native.NormalOutputs();
      outputs.normal.to(normals.normal);
      outputs.status.data = normals.status;
      var error = new Native.Error();
      Native.check(Native.LIBRARY.umb_vertex_normals(handle.pointer, points(positions), options, outputs, error), error);
      return normals;
    } finally {
      lock.readLock().unlock();
      Reference.reachabilityFence(this);
    }
  }

  public Curvatures curvatures(DoubleBuffer positions) {
    return curvatures(positions, 0);
  }

  /** Curvatures by adaptive jets. */
  public Curvatures curvatures(DoubleBuffer positions, int threads) {
    lock.readLock().lock();
    try {
      var curvatures = new Curvatures(vertexCount());
      var options = new Native.CurvatureOptions();
      options.run.threads = threads;
      var outputs = new Native.CurvatureOutputs();
      outputs.k1.to(curvatures.k1);
      outputs.k2.to(curvatures.k2);
      outputs.direction1.to(curvatures.direction1);
      outputs.direction2.to(curvatures.direction2);
      outputs.mean.to(curvatures.mean);
      outputs.gaussian.to(curvatures.gaussian);
      outputs.status.data = curvatures.status;
      var error = new Native.Error();
      Native.check(Native.LIBRARY.umb_curvatures(handle.pointer, points(positions), options, outputs, error), error);
      return curvatures;
    } finally {
      lock.readLock().unlock();
      Reference.reachabilityFence(this);
    }
  }

  private int vertexCount() {
    return (int) Native.LIBRARY.umb_topology_vertex_count(handle.pointer);
  }

  // Lengths are those of what is handed over: the caller's buffer may get another limit meanwhile.
  static Native.Points points(DoubleBuffer positions) {
    var points = new Native.Points();
    points.data = Buffers.direct(positions);
    if (points.data.remaining() % 3 != 0) {
      throw new UmbilicException(Native.SIZE, "positions are no multiple of 3 numbers", null);
    }
    points.count = points.data.remaining() / 3;
    points.scalar = Native.F64;
    return points;
  }
}
