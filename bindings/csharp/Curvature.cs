// Vertex normals and curvatures of a mesh with umbilic.
//
//   mono Curvature.exe MESH.off RESULTS    writes them as doubles, statuses as bytes, one array after the other
//   mono Curvature.exe --time MESH.off     prints how long each call takes, in milliseconds, on one thread

using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Runtime.InteropServices;
using Umbilic;

internal class Mesh {
  public double[] Positions;
  public uint[] Indices, Offsets;
  public int VertexCount;

  // Mono's double.Parse is at times one off in the last bit, and strtod looks for the decimal point of the user's language.
  [DllImport("libc")] private static extern IntPtr newlocale(int mask, string name, IntPtr basis);
  [DllImport("libc")] private static extern double strtod_l(string text, IntPtr end, IntPtr locale);
  private static readonly IntPtr Plain = newlocale(1 << 1, "C", IntPtr.Zero); // LC_NUMERIC_MASK

  private static double Number(string text) {
    double.Parse(text, NumberStyles.Float, CultureInfo.InvariantCulture); // throws if it is none
    return strtod_l(text, IntPtr.Zero, Plain);
  }

  // The lines of an OFF file that say something, as words.
  private static IEnumerable<string[]> Lines(string path) {
    foreach (string line in File.ReadLines(path)) {
      string[] words = line.Split('#')[0].Split((char[])null, StringSplitOptions.RemoveEmptyEntries);
      if (words.Length > 0) yield return words;
    }
    throw new EndOfStreamException(path + ": the file ends early");
  }

  public static Mesh ReadOff(string path) {
    using (IEnumerator<string[]> lines = Lines(path).GetEnumerator()) {
      Func<string[]> next = () => {
        lines.MoveNext();
        return lines.Current;
      };
      string[] counts = next();
      if (counts[0] != "OFF") throw new InvalidDataException(path + ": no OFF file");
      counts = counts.Length > 1 ? counts.Skip(1).ToArray() : next();
      int vertices = int.Parse(counts[0]), faces = int.Parse(counts[1]);
      var positions = new double[3 * vertices];
      for (int vertex = 0; vertex < vertices; vertex++) {
        string[] words = next();
        for (int axis = 0; axis < 3; axis++) positions[3 * vertex + axis] = Number(words[axis]);
      }
      var indices = new List<uint>();
      var offsets = new uint[faces + 1];
      for (int face = 0; face < faces; face++) {
        string[] words = next();
        uint corners = uint.Parse(words[0]);
        if (words.Length <= corners) throw new InvalidDataException(path + ": cannot read: " + string.Join(" ", words));
        indices.AddRange(words.Skip(1).Take((int)corners).Select(uint.Parse));
        offsets[face + 1] = (uint)indices.Count;
      }
      return new Mesh { Positions = positions, Indices = indices.ToArray(), Offsets = offsets, VertexCount = vertices };
    }
  }
}

internal static class Program {
  private static void Write(BinaryWriter writer, double[] numbers) {
    foreach (double number in numbers) writer.Write(number);
  }

  private static void Compute(string path, string results) {
    Mesh mesh = Mesh.ReadOff(path);
    // begin: user code
    Normals normals;
    Curvatures found;
    using (var topology = new Topology(mesh.Indices, mesh.Offsets, mesh.VertexCount)) {
      normals = topology.VertexNormals(mesh.Positions);
      found = topology.Curvatures(mesh.Positions);
    }
    // end: user code
    using (var writer = new BinaryWriter(File.Create(results))) {
      Write(writer, normals.Normal);
      writer.Write(normals.Status);
      foreach (double[] array in new[] { found.K1, found.K2, found.Direction1, found.Direction2, found.Mean, found.Gaussian }) {
        Write(writer, array);
      }
      writer.Write(found.Status);
    }
  }

  private static void Time(string path) {
    Mesh mesh = Mesh.ReadOff(path);
    for (int round = 0; round < 20; round++) {
      var clock = Stopwatch.StartNew();
      using (var topology = new Topology(mesh.Indices, mesh.Offsets, mesh.VertexCount, 1)) {
        double built = clock.Elapsed.TotalMilliseconds;
        topology.VertexNormals(mesh.Positions, 1);
        double shaded = clock.Elapsed.TotalMilliseconds;
        topology.Curvatures(mesh.Positions, 1);
        double done = clock.Elapsed.TotalMilliseconds;
        Console.WriteLine(FormattableString.Invariant($"{built:F6}\t{shaded - built:F6}\t{done - shaded:F6}"));
      }
    }
  }

  private static int Main(string[] arguments) {
    try {
      if (arguments.Length != 2) throw new ArgumentException("usage: Curvature.exe MESH.off RESULTS | --time MESH.off");
      if (arguments[0] == "--time") Time(arguments[1]);
      else Compute(arguments[0], arguments[1]);
      return 0;
    } catch (Exception failure) {
      Console.Error.WriteLine($"{failure.GetType().Name}: {failure.Message}");
    }
    return 1;
  }
}
