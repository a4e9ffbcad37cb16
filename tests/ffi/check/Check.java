// What tests/ffi/test.py asks of bindings/java: java umbilic.Check layout | MISTAKE. In the package, whose structs it looks at.
package umbilic;

import com.sun.jna.Structure;
import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.ObjectInputStream;
import java.io.ObjectOutputStream;
import java.nio.BufferOverflowException;
import java.nio.ByteBuffer;
import java.nio.DoubleBuffer;
import java.nio.IntBuffer;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.OptionalLong;
import java.util.concurrent.Callable;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;

class Check {
  interface Action {
    void run() throws Exception;
  }

  // A tetrahedron, in buffers of the heap: the copies are tested as well.
  static IntBuffer indices() {
    return IntBuffer.wrap(new int[] {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2});
  }

  static DoubleBuffer positions() {
    return DoubleBuffer.wrap(new double[] {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  }

  static Topology tetrahedron() {
    return new Topology(indices(), null, 4);
  }

  static Topology closed() {
    Topology mesh = tetrahedron();
    mesh.close();
    return mesh;
  }

  static void check(boolean good) {
    if (!good) throw new IllegalStateException("not as expected");
  }

  static String name(Class<?> struct) {
    return "umb" + struct.getSimpleName().replaceAll("([A-Z])", "_$1").toLowerCase(Locale.ROOT);
  }

  static void layout() throws ReflectiveOperationException {
    for (Class<?> type : Native.class.getDeclaredClasses()) {
      if (!Structure.class.isAssignableFrom(type) || type == Native.Sized.class) continue;
      var struct = (Structure) type.getDeclaredConstructor().newInstance();
      System.out.println(name(type) + " " + struct.size());
      // JNA tells places of fields only in text: "type name@0xplace=value", "type name[length]@…".
      var fields = java.util.regex.Pattern.compile("(?m)^  \\S+ (\\w+)(?:\\[\\d+])?@0x([0-9A-F]+)=").matcher(struct.toString());
      while (fields.find()) System.out.println(name(type) + "." + fields.group(1) + " " + Integer.parseInt(fields.group(2), 16));
    }
  }

  /** Views of every kind give the same bits: direct ones are taken as they are, others are copied. */
  static void views() {
    DoubleBuffer direct = Buffers.doubles(15).position(3).put(positions()).position(3);
    DoubleBuffer swapped = ByteBuffer.allocateDirect(12 * 8).asDoubleBuffer().put(positions()).rewind();
    check(direct.order() != swapped.order());
    try (Topology mesh = tetrahedron()) {
      Curvatures expected = mesh.curvatures(positions());
      for (DoubleBuffer view : List.of(direct, swapped, positions().asReadOnlyBuffer())) {
        check(mesh.curvatures(view).k1.equals(expected.k1));
      }
      check(direct.position() == 3);
    }
  }

  /** Another thread moves the limit of a buffer: what is counted is what is handed over. */
  static void moving() throws InterruptedException {
    DoubleBuffer shared = positions();
    var done = new AtomicBoolean();
    var mover = new Thread(() -> {
      while (!done.get()) shared.limit(9).limit(12);
    });
    mover.start();
    try {
      tetrahedron().close();
      for (int i = 0; i < 200_000; i++) {
        try {
          Native.Points points = Topology.points(shared);
          check(3 * points.count == points.data.remaining());
        } catch (BufferOverflowException moved) {
          // A copy that turned out too short.
        }
      }
    } finally {
      done.set(true);
      mover.join();
    }
  }

  /** An exception that has been written and read again. */
  static void written() throws IOException, ClassNotFoundException {
    var bytes = new ByteArrayOutputStream();
    try (Topology mesh = tetrahedron()) {
      mesh.curvatures(positions().put(7, Double.NaN));
    } catch (UmbilicException refusal) {
      new ObjectOutputStream(bytes).writeObject(refusal);
    }
    var read = (UmbilicException) new ObjectInputStream(new ByteArrayInputStream(bytes.toByteArray())).readObject();
    check(read.status() == 10 && read.element().equals(OptionalLong.of(2)));
  }

  static void threads() {
    try (var one = new Topology(indices(), null, 4, 1); var three = new Topology(indices(), null, 4, 3)) {
      check(one.vertexNormals(positions(), 1).normal.equals(three.vertexNormals(positions(), 3).normal));
      check(one.curvatures(positions(), 1).k1.equals(three.curvatures(positions(), 3).k1));
    }
  }

  static void empty() {
    try (var mesh = new Topology(IntBuffer.allocate(0), null, 0)) {
      check(mesh.vertexNormals(DoubleBuffer.allocate(0)).normal.capacity() == 0);
      check(mesh.curvatures(DoubleBuffer.allocate(0)).k1.capacity() == 0);
    }
  }

  static void forgotten() throws InterruptedException {
    for (int i = 0; i < 10; i++) tetrahedron();
    for (int i = 0; i < 10; i++) {
      System.gc();
      Thread.sleep(20); // cleaners run in a thread of their own
    }
  }

  /** Eight threads use a topology while it is closed: each call has its results, or says that it is closed. */
  static void concurrent() throws InterruptedException, ExecutionException {
    var pool = Executors.newFixedThreadPool(8);
    for (int round = 0; round < 50; round++) {
      Topology mesh = tetrahedron();
      var calls = new ArrayList<Future<Curvatures>>();
      for (int i = 0; i < 8; i++) calls.add(pool.submit((Callable<Curvatures>) () -> mesh.curvatures(positions(), 1)));
      TimeUnit.MICROSECONDS.sleep(500);
      mesh.close();
      for (Future<Curvatures> call : calls) {
        try {
          check(call.get().k1.capacity() == 4);
        } catch (ExecutionException failure) {
          if (!(failure.getCause() instanceof UmbilicException)) throw failure;
        }
      }
    }
    pool.shutdown();
  }

  static final Map<String, Action> ACTIONS =
      Map.ofEntries(
          Map.entry("layout", Check::layout),
          Map.entry("index", () -> new Topology(indices().put(4, 4), null, 4)),
          Map.entry("offsets", () -> new Topology(indices(), IntBuffer.wrap(new int[] {0, 3, 2, 9, 12}), 4)),
          Map.entry("no-offsets", () -> new Topology(indices(), IntBuffer.allocate(0), 4)),
          Map.entry("indices-size", () -> new Topology(indices().limit(11), null, 4)),
          Map.entry("count", () -> new Topology(indices(), null, -1)),
          Map.entry("positions-size", () -> tetrahedron().vertexNormals(positions().limit(9))),
          Map.entry("ragged", () -> tetrahedron().curvatures(DoubleBuffer.allocate(13))),
          Map.entry("missing", () -> tetrahedron().curvatures(null)),
          Map.entry("nan-normals", () -> tetrahedron().vertexNormals(positions().put(7, Double.NaN))),
          Map.entry("nan-curvatures", () -> tetrahedron().curvatures(positions().put(7, Double.NaN))),
          Map.entry("closed-normals", () -> closed().vertexNormals(positions())),
          Map.entry("closed-curvatures", () -> closed().curvatures(positions())),
          Map.entry("twice", () -> closed().close()),
          Map.entry("empty", Check::empty),
          Map.entry("threads", Check::threads),
          Map.entry("views", Check::views),
          Map.entry("moving", Check::moving),
          Map.entry("written", Check::written),
          Map.entry("forgotten", Check::forgotten),
          Map.entry("concurrent", Check::concurrent));

  public static void main(String[] arguments) throws Exception {
    try {
      ACTIONS.get(arguments[0]).run();
    } catch (UmbilicException refusal) {
      System.err.println(refusal);
      System.exit(1);
    }
  }
}
