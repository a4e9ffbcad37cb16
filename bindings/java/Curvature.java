// Vertex normals and curvatures of a mesh with umbilic.
//
//   java Curvature MESH.off RESULTS    writes them as doubles, statuses as bytes, one array after the other
//   java Curvature --time MESH.off     prints how long each call takes, in milliseconds, on one thread

import java.io.EOFException;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.DoubleBuffer;
import java.nio.IntBuffer;
import java.nio.channels.FileChannel;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.Arrays;
import java.util.Iterator;
import java.util.Locale;
import umbilic.Buffers;
import umbilic.Curvatures;
import umbilic.Normals;
import umbilic.Topology;

public class Curvature {
  static class Mesh {
    DoubleBuffer positions;
    IntBuffer indices;
    IntBuffer offsets;
    int vertexCount;
  }

  static String[] next(Iterator<String[]> lines) throws EOFException {
    if (!lines.hasNext()) throw new EOFException("the file ends early");
    return lines.next();
  }

  static Mesh readOff(Path path) throws IOException {
    try (var text = Files.lines(path, StandardCharsets.ISO_8859_1)) {
      Iterator<String[]> lines =
          text.map(line -> line.replaceFirst("#.*", "").trim()).filter(line -> !line.isEmpty()).map(line -> line.split("\\s+")).iterator();
      String[] counts = next(lines);
      if (!counts[0].equals("OFF")) throw new IOException(path + ": no OFF file");
      counts = counts.length > 1 ? Arrays.copyOfRange(counts, 1, counts.length) : next(lines);
      var mesh = new Mesh();
      mesh.vertexCount = Integer.parseInt(counts[0]);
      int faceCount = Integer.parseInt(counts[1]);
      mesh.positions = Buffers.doubles(3 * mesh.vertexCount);
      for (int vertex = 0; vertex < mesh.vertexCount; vertex++) {
        String[] words = next(lines);
        for (int axis = 0; axis < 3; axis++) mesh.positions.put(Double.parseDouble(words[axis]));
      }
      mesh.positions.flip();
      var faces = new int[faceCount][];
      mesh.offsets = Buffers.integers(faceCount + 1).put(0);
      int corners = 0;
      for (int face = 0; face < faceCount; face++) {
        String[] words = next(lines);
        faces[face] = Arrays.stream(words, 1, 1 + Integer.parseInt(words[0])).mapToInt(Integer::parseInt).toArray();
        corners += faces[face].length;
        mesh.offsets.put(corners);
      }
      mesh.offsets.flip();
      mesh.indices = Buffers.integers(corners);
      for (int[] face : faces) mesh.indices.put(face);
      mesh.indices.flip();
      return mesh;
    }
  }

  static void write(FileChannel file, DoubleBuffer... arrays) throws IOException {
    for (DoubleBuffer array : arrays) {
      ByteBuffer bytes = ByteBuffer.allocate(array.capacity() * Double.BYTES).order(ByteOrder.nativeOrder());
      bytes.asDoubleBuffer().put(array);
      file.write(bytes);
    }
  }

  static void compute(Path path, Path results) throws IOException {
    Mesh mesh = readOff(path);
    // begin: user code
    Normals normals;
    Curvatures found;
    try (var topology = new Topology(mesh.indices, mesh.offsets, mesh.vertexCount)) {
      normals = topology.vertexNormals(mesh.positions);
      found = topology.curvatures(mesh.positions);
    }
    // end: user code
    try (var file = FileChannel.open(results, StandardOpenOption.CREATE, StandardOpenOption.TRUNCATE_EXISTING, StandardOpenOption.WRITE)) {
      write(file, normals.normal);
      file.write(normals.status);
      write(file, found.k1, found.k2, found.direction1, found.direction2, found.mean, found.gaussian);
      file.write(found.status);
    }
  }

  static void time(Path path) throws IOException {
    Mesh mesh = readOff(path);
    for (int round = 0; round < 20; round++) {
      long start = System.nanoTime();
      try (var topology = new Topology(mesh.indices, mesh.offsets, mesh.vertexCount, 1)) {
        long built = System.nanoTime();
        topology.vertexNormals(mesh.positions, 1);
        long shaded = System.nanoTime();
        topology.curvatures(mesh.positions, 1);
        long done = System.nanoTime();
        System.out.printf(Locale.ROOT, "%.6f\t%.6f\t%.6f%n", (built - start) * 1e-6, (shaded - built) * 1e-6, (done - shaded) * 1e-6);
      }
    }
  }

  public static void main(String[] arguments) {
    try {
      if (arguments.length != 2) throw new IllegalArgumentException("usage: Curvature MESH.off RESULTS | --time MESH.off");
      if (arguments[0].equals("--time")) time(Path.of(arguments[1]));
      else compute(Path.of(arguments[0]), Path.of(arguments[1]));
    } catch (IOException | RuntimeException failure) {
      System.err.println(failure);
      System.exit(1);
    }
  }
}
