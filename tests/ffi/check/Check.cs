// What tests/ffi/test.py asks of bindings/csharp: mono Check.exe layout | MISTAKE. Compiled together with the binding, whose structs it
// looks at.

using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Text.RegularExpressions;
using System.Threading;
using System.Threading.Tasks;
using Umbilic;

internal static class Check {
  // A tetrahedron.
  private static uint[] Indices() => new uint[] { 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2 };
  private static double[] Positions() => new double[] { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  private static Topology Tetrahedron() => new Topology(Indices(), null, 4);

  private static T[] With<T>(T[] array, int place, T value) {
    array[place] = value;
    return array;
  }

  private static Topology Closed() {
    Topology mesh = Tetrahedron();
    mesh.Dispose();
    return mesh;
  }

  private static void Good(bool good) {
    if (!good) throw new InvalidOperationException("not as expected");
  }

  // The name of a struct or field in the header.
  private static string Snake(string name) => Regex.Replace(name, "(?<!^)([A-Z])", "_$1").ToLowerInvariant();

  private static void Layout() {
    foreach (Type type in typeof(Topology).Assembly.GetTypes()) {
      if (type.Namespace != "Umbilic" || !type.IsValueType || type.IsNested) continue;
      string name = "umb_" + Snake(type.Name);
      Console.WriteLine($"{name} {Marshal.SizeOf(type)}");
      foreach (FieldInfo field in type.GetFields(BindingFlags.Instance | BindingFlags.Public)) {
        Console.WriteLine($"{name}.{Snake(field.Name)} {Marshal.OffsetOf(type, field.Name)}");
      }
    }
  }

  private static void Empty() {
    using (var mesh = new Topology(new uint[0], null, 0)) {
      Good(mesh.VertexNormals(new double[0]).Normal.Length == 0 && mesh.Curvatures(new double[0]).K1.Length == 0);
    }
  }

  private static void Threads() {
    using (var one = new Topology(Indices(), null, 4, 1))
    using (var three = new Topology(Indices(), null, 4, 3)) {
      Good(one.VertexNormals(Positions(), 1).Normal.SequenceEqual(three.VertexNormals(Positions(), 3).Normal));
      Good(one.Curvatures(Positions(), 1).K1.SequenceEqual(three.Curvatures(Positions(), 3).K1));
    }
  }

  private static void Forgotten() {
    // Mono looks at the stack without knowing what lies there: what a thread that has ended held is forgotten for certain.
    var thread = new Thread(() => {
      for (int i = 0; i < 10; i++) Tetrahedron();
    });
    thread.Start();
    thread.Join();
    for (int i = 0; i < 3; i++) {
      GC.Collect();
      GC.WaitForPendingFinalizers();
    }
  }

  // Eight threads use a topology while it is disposed of: each call has its results, or says so.
  private static void Concurrent() {
    for (int round = 0; round < 50; round++) {
      Topology mesh = Tetrahedron();
      Task[] calls = Enumerable.Range(0, 8).Select(i => Task.Run(() => {
        try {
          Good(mesh.Curvatures(Positions(), 1).K1.Length == 4);
        } catch (ObjectDisposedException) {
        }
      })).ToArray();
      Thread.Sleep(round % 2); // milliseconds
      mesh.Dispose();
      Task.WaitAll(calls);
    }
  }

  private static readonly Dictionary<string, Action> Actions = new Dictionary<string, Action> {
    ["layout"] = Layout,
    ["index"] = () => new Topology(With(Indices(), 4, 4u), null, 4),
    ["offsets"] = () => new Topology(Indices(), new uint[] { 0, 3, 2, 9, 12 }, 4),
    ["no-offsets"] = () => new Topology(Indices(), new uint[0], 4),
    ["indices-size"] = () => new Topology(Indices().Take(11).ToArray(), null, 4),
    ["count"] = () => new Topology(Indices(), null, -1),
    ["positions-size"] = () => Tetrahedron().VertexNormals(Positions().Take(9).ToArray()),
    ["ragged"] = () => Tetrahedron().Curvatures(new double[13]),
    ["missing"] = () => Tetrahedron().Curvatures(null),
    ["nan-normals"] = () => Tetrahedron().VertexNormals(With(Positions(), 7, double.NaN)),
    ["nan-curvatures"] = () => Tetrahedron().Curvatures(With(Positions(), 7, double.NaN)),
    ["closed-normals"] = () => Closed().VertexNormals(Positions()),
    ["closed-curvatures"] = () => Closed().Curvatures(Positions()),
    ["twice"] = () => Closed().Dispose(),
    ["empty"] = Empty,
    ["threads"] = Threads,
    ["forgotten"] = Forgotten,
    ["concurrent"] = Concurrent,
  };

  private static int Main(string[] arguments) {
    try {
      Actions[arguments[0]]();
      return 0;
    } catch (Exception failure) {
      Console.Error.WriteLine($"{failure.GetType().Name}: {failure.Message}");
    }
    return 1;
  }
}
