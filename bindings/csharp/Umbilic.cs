// umbilic for C#: vertex normals and curvatures of polygon meshes, on arrays. See include/umbilic.h for what everything means.
//
//   using (var mesh = new Umbilic.Topology(indices, null, vertexCount)) {       // uint[], triangles
//     Umbilic.Curvatures found = mesh.Curvatures(positions);                    // double[], x y z of each vertex
//   }
//
// Arrays are pinned for the call, neither copied nor kept.

using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Umbilic {

/// <summary>What the library refused.</summary>
public class UmbilicException : Exception {
  /// <summary>A UMB_ERROR_ constant.</summary>
  public int Status { get; }
  /// <summary>The offending corner, face, vertex or value; null if there is none.</summary>
  public ulong? Element { get; }

  public UmbilicException(int status, string message, ulong? element = null)
      : base(message + (element == null ? $" (status {status})" : $" (status {status}, element {element})")) {
    Status = status;
    Element = element;
  }
}

/// <summary>Vertex normals.</summary>
public class Normals {
  /// <summary>Unit vectors, x y z of each vertex.</summary>
  public double[] Normal { get; }
  /// <summary>UMB_VERTEX_ bits.</summary>
  public byte[] Status { get; }

  internal Normals(int vertices) {
    Normal = new double[checked(3 * vertices)];
    Status = new byte[vertices];
  }
}

/// <summary>Curvatures of vertices; directions have x y z of each.</summary>
public class Curvatures {
  public double[] K1 { get; }
  public double[] K2 { get; }
  public double[] Direction1 { get; }
  public double[] Direction2 { get; }
  public double[] Mean { get; }
  public double[] Gaussian { get; }
  /// <summary>UMB_VERTEX_ bits.</summary>
  public byte[] Status { get; }

  internal Curvatures(int vertices) {
    K1 = new double[vertices];
    K2 = new double[vertices];
    Direction1 = new double[checked(3 * vertices)];
    Direction2 = new double[checked(3 * vertices)];
    Mean = new double[vertices];
    Gaussian = new double[vertices];
    Status = new byte[vertices];
  }
}

/// <summary>The one-rings of a mesh, built once from its faces and used while positions move, by many threads at once if need
/// be. Freed by Dispose, once calls that use it have returned, or by the garbage collector; calls that follow throw
/// ObjectDisposedException.</summary>
public sealed unsafe class Topology : IDisposable {
  private readonly TopologyHandle handle;

  /// <param name="indices">the vertices of all faces, one face after the other, from 0</param>
  /// <param name="offsets">where each face starts, and the end of the last; null for triangles</param>
  /// <param name="vertexCount">the number of vertices</param>
  /// <param name="threads">0 for as many as pay</param>
  public Topology(uint[] indices, uint[] offsets, int vertexCount, uint threads = 0) {
    if (Native.umb_abi_version() != 0) {
      throw new DllNotFoundException("libumbilic has another binary interface than Umbilic.cs");
    }
    if (indices == null) throw new ArgumentNullException(nameof(indices));
    if (vertexCount < 0) throw new ArgumentOutOfRangeException(nameof(vertexCount));
    if (offsets != null && offsets.Length == 0) throw new ArgumentException("one more than faces", nameof(offsets));
    var options = new TopologyOptions { StructSize = (uint)sizeof(TopologyOptions), Threads = threads };
    Error error = Error.Sized;
    fixed (uint* firstIndex = indices, firstOffset = offsets) {
      var faces = new Faces {
        Indices = firstIndex,
        IndexCount = (UIntPtr)indices.Length,
        Offsets = firstOffset,
        FaceCount = (UIntPtr)(offsets == null ? 0 : offsets.Length - 1),
      };
      Native.Check(Native.umb_topology_create(&faces, (UIntPtr)vertexCount, &options, out handle, &error), &error);
    }
  }

  /// <summary>Unit normals (N_CM).</summary>
  public Normals VertexNormals(double[] positions, uint threads = 0) {
    var normals = new Normals(VertexCount);
    var options = new NormalOptions { StructSize = (uint)sizeof(NormalOptions) };
    options.Run.Threads = threads;
    Error error = Error.Sized;
    fixed (double* position = positions, normal = normals.Normal)
    fixed (byte* status = normals.Status) {
      Points points = Points.Of(positions, position);
      var outputs = new NormalOutputs { StructSize = (uint)sizeof(NormalOutputs), Normal = Output.To(normal) };
      outputs.Status.Data = status;
      Native.Check(Native.umb_vertex_normals(handle, &points, &options, &outputs, &error), &error);
    }
    return normals;
  }

  /// <summary>Curvatures by adaptive jets.</summary>
  public Curvatures Curvatures(double[] positions, uint threads = 0) {
    var found = new Curvatures(VertexCount);
    var options = new CurvatureOptions { StructSize = (uint)sizeof(CurvatureOptions) };
    options.Run.Threads = threads;
    Error error = Error.Sized;
    fixed (double* position = positions, k1 = found.K1, k2 = found.K2, direction1 = found.Direction1,
           direction2 = found.Direction2, mean = found.Mean, gaussian = found.Gaussian)
    fixed (byte* status = found.Status) {
      Points points = Points.Of(positions, position);
      var outputs = new CurvatureOutputs {
        StructSize = (uint)sizeof(CurvatureOutputs),
        K1 = Output.To(k1),
        K2 = Output.To(k2),
        Direction1 = Output.To(direction1),
        Direction2 = Output.To(direction2),
        Mean = Output.To(mean),
        Gaussian = Output.To(gaussian),
      };
      outputs.Status.Data = status;
      Native.Check(Native.umb_curvatures(handle, &points, &options, &outputs, &error), &error);
    }
    return found;
  }

  public int VertexCount => (int)Native.umb_topology_vertex_count(handle);

  public void Dispose() => handle.Dispose();
}

internal sealed class TopologyHandle : SafeHandle {
  private TopologyHandle() : base(IntPtr.Zero, true) {}

  public override bool IsInvalid => handle == IntPtr.Zero;

  protected override bool ReleaseHandle() {
    Native.umb_topology_destroy(handle);
    return true;
  }
}

internal static unsafe class Native {
  private const string Library = "libumbilic.so.0";

  [DllImport(Library)] internal static extern uint umb_abi_version();
  [DllImport(Library)] internal static extern int umb_topology_create(Faces* faces, UIntPtr vertexCount, TopologyOptions* options,
                                                                      out TopologyHandle topology, Error* error);
  [DllImport(Library)] internal static extern void umb_topology_destroy(IntPtr topology);
  [DllImport(Library)] internal static extern UIntPtr umb_topology_vertex_count(TopologyHandle topology);
  [DllImport(Library)] internal static extern int umb_vertex_normals(TopologyHandle topology, Points* points, NormalOptions* options,
                                                                     NormalOutputs* outputs, Error* error);
  [DllImport(Library)] internal static extern int umb_curvatures(TopologyHandle topology, Points* points, CurvatureOptions* options,
                                                                 CurvatureOutputs* outputs, Error* error);

  internal static void Check(int status, Error* error) {
    if (status == 0) return;
    int length = 0;
    while (error->Message[length] != 0) length++;
    string message = Encoding.UTF8.GetString(error->Message, length);
    throw new UmbilicException(status, message, error->Element == ulong.MaxValue ? (ulong?)null : error->Element);
  }
}

// The structs of the header, field by field.

[StructLayout(LayoutKind.Sequential)]
internal unsafe struct Error {
  public uint StructSize;
  public int Status;
  public ulong Element;
  public fixed byte Message[240];

  internal static Error Sized => new Error { StructSize = (uint)sizeof(Error) };
}

[StructLayout(LayoutKind.Sequential)]
internal unsafe struct Faces {
  public void* Indices;
  public UIntPtr IndexCount;
  public void* Offsets;
  public UIntPtr FaceCount;
  public uint Index, Arity;
}

[StructLayout(LayoutKind.Sequential)]
internal struct TopologyOptions {
  public uint StructSize, Threads, Simd, Reserved;
}

[StructLayout(LayoutKind.Sequential)]
internal unsafe struct Points {
  public void* Data;
  public UIntPtr Count, Stride;
  public uint Scalar, Reserved;

  internal static Points Of(double[] positions, double* first) {
    if (positions == null) throw new ArgumentNullException(nameof(positions));
    if (positions.Length % 3 != 0) throw new ArgumentException("no multiple of 3 numbers", nameof(positions));
    return new Points { Data = first, Count = (UIntPtr)(positions.Length / 3), Scalar = Output.F64 };
  }
}

[StructLayout(LayoutKind.Sequential)]
internal unsafe struct Output {
  internal const uint F64 = 1; // UMB_SCALAR_F64

  public void* Data;
  public UIntPtr Stride;
  public uint Scalar, Reserved;

  internal static Output To(double* first) => new Output { Data = first, Scalar = F64 };
}

[StructLayout(LayoutKind.Sequential)]
internal unsafe struct StatusOutput {
  public byte* Data;
  public UIntPtr Stride;
}

[StructLayout(LayoutKind.Sequential)]
internal unsafe struct Run {
  public uint Threads, Simd;
  public uint* Vertices;
  public UIntPtr VertexCount;
  public IntPtr Progress;
  public void* User;
}

[StructLayout(LayoutKind.Sequential)]
internal unsafe struct NormalOptions {
  public uint StructSize, Weight;
  public Run Run;
  public uint Degree, Rings;
  public void* Model;
}

[StructLayout(LayoutKind.Sequential)]
internal struct NormalOutputs {
  public uint StructSize, Reserved;
  public Output Normal, Sum;
  public StatusOutput Status;
}

[StructLayout(LayoutKind.Sequential)]
internal unsafe struct CurvatureOptions {
  public uint StructSize, Method, Section, Weight;
  public double Radius;
  public uint Degree, Rings, NormalDegree, NormalRings;
  public void* Model;
  public Points Normals;
  public Run Run;
}

[StructLayout(LayoutKind.Sequential)]
internal struct CurvatureOutputs {
  public uint StructSize, Reserved;
  public Output K1, K2, Direction1, Direction2, Mean, Gaussian, MeanNormal, Area, IntegratedMean, IntegratedGaussian, ShapeIndex,
    Curvedness, Residual, Condition, DegreesOfFreedom, Normal;
  public StatusOutput Status;
}

}
