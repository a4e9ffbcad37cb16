package umbilic;

import com.sun.jna.Library;
import com.sun.jna.Pointer;
import com.sun.jna.Structure;
import com.sun.jna.Structure.FieldOrder;
import com.sun.jna.ptr.PointerByReference;
import java.nio.Buffer;

/** The functions and structs of include/umbilic.h, field by field, for 64-bit machines. */
final class Native {
  static final int F64 = 1; // UMB_SCALAR_F64
  static final int I32 = 1; // UMB_INDEX_I32
  static final int SIZE = 7; // UMB_ERROR_SIZE
  static final long NO_ELEMENT = -1;

  static final Functions LIBRARY = com.sun.jna.Native.load("libumbilic.so.0", Functions.class);

  static {
    if (LIBRARY.umb_abi_version() != 0) throw new UnsatisfiedLinkError("libumbilic has another binary interface than Native.java");
  }

  interface Functions extends Library {
    int umb_abi_version();

    int umb_topology_create(Faces faces, long vertexCount, TopologyOptions options, PointerByReference topology, Error error);

    void umb_topology_destroy(Pointer topology);

    long umb_topology_vertex_count(Pointer topology);

    int umb_vertex_normals(Pointer topology, Points points, NormalOptions options, NormalOutputs outputs, Error error);

    int umb_curvatures(Pointer topology, Points points, CurvatureOptions options, CurvatureOutputs outputs, Error error);
  }

  static void check(int status, Error error) {
    if (status == 0) return;
    String message = com.sun.jna.Native.toString(error.message, "UTF-8");
    throw new UmbilicException(status, message, error.element == NO_ELEMENT ? null : error.element);
  }

  /** A struct that starts with its size. */
  @FieldOrder("struct_size")
  public abstract static class Sized extends Structure {
    public int struct_size;

    @Override
    public void write() {
      struct_size = size();
      super.write();
    }
  }

  @FieldOrder({"status", "element", "message"})
  public static class Error extends Sized {
    public int status;
    public long element;
    public byte[] message = new byte[240];
  }

  @FieldOrder({"indices", "index_count", "offsets", "face_count", "index", "arity"})
  public static class Faces extends Structure {
    public Buffer indices;
    public long index_count;
    public Buffer offsets;
    public long face_count;
    public int index = I32;
    public int arity;
  }

  @FieldOrder({"threads", "simd", "reserved"})
  public static class TopologyOptions extends Sized {
    public int threads;
    public int simd;
    public int reserved;
  }

  @FieldOrder({"data", "count", "stride", "scalar", "reserved"})
  public static class Points extends Structure {
    public Buffer data;
    public long count;
    public long stride;
    public int scalar;
    public int reserved;
  }

  @FieldOrder({"data", "stride", "scalar", "reserved"})
  public static class Output extends Structure {
    public Buffer data;
    public long stride;
    public int scalar;
    public int reserved;

    void to(Buffer doubles) {
      data = doubles;
      scalar = F64;
    }
  }

  @FieldOrder({"data", "stride"})
  public static class StatusOutput extends Structure {
    public Buffer data;
    public long stride;
  }

  @FieldOrder({"threads", "simd", "vertices", "vertex_count", "progress", "user"})
  public static class Run extends Structure {
    public int threads;
    public int simd;
    public Pointer vertices;
    public long vertex_count;
    public Pointer progress;
    public Pointer user;
  }

  @FieldOrder({"weight", "run", "degree", "rings", "model"})
  public static class NormalOptions extends Sized {
    public int weight;
    public Run run;
    public int degree;
    public int rings;
    public Pointer model;
  }

  @FieldOrder({"reserved", "normal", "sum", "status"})
  public static class NormalOutputs extends Sized {
    public int reserved;
    public Output normal;
    public Output sum;
    public StatusOutput status;
  }

  @FieldOrder({
    "method", "section", "weight", "radius", "degree", "rings", "normal_degree", "normal_rings", "model", "normals", "run"
  })
  public static class CurvatureOptions extends Sized {
    public int method;
    public int section;
    public int weight;
    public double radius;
    public int degree;
    public int rings;
    public int normal_degree;
    public int normal_rings;
    public Pointer model;
    public Points normals;
    public Run run;
  }

  @FieldOrder({
    "reserved", "k1", "k2", "direction1", "direction2", "mean", "gaussian", "mean_normal", "area", "integrated_mean",
    "integrated_gaussian", "shape_index", "curvedness", "residual", "condition", "degrees_of_freedom", "normal", "status"
  })
  public static class CurvatureOutputs extends Sized {
    public int reserved;
    public Output k1;
    public Output k2;
    public Output direction1;
    public Output direction2;
    public Output mean;
    public Output gaussian;
    public Output mean_normal;
    public Output area;
    public Output integrated_mean;
    public Output integrated_gaussian;
    public Output shape_index;
    public Output curvedness;
    public Output residual;
    public Output condition;
    public Output degrees_of_freedom;
    public Output normal;
    public StatusOutput status;
  }
}
