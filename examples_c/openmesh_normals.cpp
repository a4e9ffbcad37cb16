/*
 * Vertex normals of OpenMesh meshes by umbilic, in OpenMesh's own memory, compared with OpenMesh's own.
 *
 * Build and run, in this directory, after `cargo build --release` in the one above:
 *
 *   ln -sf libumbilic.so ../target/release/libumbilic.so.0
 *   c++ -std=c++17 -O2 -Wall -Wextra -I../include openmesh_normals.cpp -o openmesh_normals \
 *     -L../target/release -lumbilic -lOpenMeshCore -Wl,-rpath,../target/release
 *   ./openmesh_normals [-o DIRECTORY] FILE...
 *
 * With -o, each mesh is written there as PLY, with N_CM as normals and as colours.
 *
 * Each mesh is tried with coordinates in double and in float. Because OpenMesh's readers go through float, coordinates
 * are divided by 3 after reading, which fills all digits of a double. OpenMesh's normals and umbilic's are:
 *
 *   fast     calc_vertex_normal_fast: the sum of the faces' unit normals; UMB_WEIGHT_UNIFORM
 *   correct  calc_vertex_normal_correct: the sum of a x b, where a and b are the edges of each corner. On triangles
 *            that is twice the area; UMB_WEIGHT_AREA. On polygons it is a weight of its own, and is not compared.
 *
 * They have to agree within 1e-12 on a double mesh. On a float mesh OpenMesh computes in float, so the yardstick there
 * is OpenMesh on the same coordinates held in double, and umbilic's float result has to agree within 1e-6; how far
 * OpenMesh's own float result lies from umbilic's is printed beside.
 *
 * A vertex that differs by more needs a reason, or the program fails:
 *
 *   cancelled  the faces' normals add up to nothing: umbilic says so in its status and takes another weight
 *   gaps       there are several gaps between the faces at the vertex: calc_vertex_normal_correct carries the last edge
 *              before a gap over to the first face behind it; the same sum with the right edges agrees with umbilic
 *   rounding   the difference is within the rounding error of OpenMesh's formula, which is large for slivers, for sums
 *              short against their terms, and for polygons far from the origin: it takes the normals of these from
 *              absolute coordinates
 */

#if defined(__GNUC__) && !defined(__clang__)
// OpenMesh fills its arrays with vectors that it leaves uninitialised, which gcc reports after inlining.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <umbilic/openmesh.hpp>

namespace {

using Vec3d = OpenMesh::Vec3d;
using TriangleMeshFloat = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraits>;
using TriangleMeshDouble = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using PolygonMeshFloat = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraits>;
using PolygonMeshDouble = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

enum class Method { fast, correct };

template <class Vector>
Vec3d unit(const Vector &vector) {
  const Vec3d wide(vector[0], vector[1], vector[2]);
  const double length = wide.norm();
  return length > 0.0 ? wide / length : wide;
}

// OpenMesh's own normal; for `fast` the mesh must have face normals.
template <class Mesh>
Vec3d openmesh_normal(const Mesh &mesh, OpenMesh::VertexHandle vertex, Method method) {
  typename Mesh::Normal normal;
  if (method == Method::fast) {
    mesh.calc_vertex_normal_fast(vertex, normal);
  } else {
    mesh.calc_vertex_normal_correct(vertex, normal);
  }
  return unit(normal);
}

// How far rounding may move OpenMesh's normal of a face: `a x b` is off by units in the last place of |a| |b|, and a
// unit vector never by more than 2.
template <class Mesh>
double face_error(const Mesh &mesh, OpenMesh::FaceHandle face) {
  double products = 0.0;
  Vec3d twice_area(0.0, 0.0, 0.0);
  const Vec3d origin = mesh.point(*mesh.cfv_begin(face));
  for (const auto halfedge : mesh.fh_range(face)) {
    const Vec3d from = mesh.point(halfedge.from()), to = mesh.point(halfedge.to());
    const Vec3d next = mesh.point(halfedge.next().to());
    twice_area += (from - origin).cross(to - origin);
    // OpenMesh takes triangles from two edges, polygons by Newell's formula.
    const double side = (to - from).norm();
    products = mesh.is_trimesh() ? std::max(products, side * (next - to).norm()) : products + side * (to + from).norm();
  }
  const double error = 4.0 * std::numeric_limits<double>::epsilon() * products;
  return error < 2.0 * twice_area.norm() ? error / twice_area.norm() : 2.0;
}

// A vertex as OpenMesh's formula sees it.
struct Around {
  Vec3d sum{0.0, 0.0, 0.0};  // of the terms, with the right edges
  double error = 0.0;        // what rounding may have done to it, to first order
  int gaps = 0;              // between its faces
};

template <class Mesh>
Around look_around(const Mesh &mesh, OpenMesh::VertexHandle vertex, Method method) {
  Around around;
  for (const auto halfedge : mesh.voh_range(vertex)) {
    if (halfedge.is_boundary()) {
      around.gaps++;
      continue;
    }
    const Vec3d here = mesh.point(vertex);
    const Vec3d a = mesh.point(halfedge.to()) - here, b = mesh.point(halfedge.prev().from()) - here;
    if (method == Method::fast) {
      around.sum += mesh.normal(halfedge.face());
      around.error += face_error(mesh, halfedge.face());
    } else {
      around.sum += a.cross(b);
      around.error += 4.0 * std::numeric_limits<double>::epsilon() * a.norm() * b.norm();
    }
  }
  return around;
}

struct Line {
  double largest = 0.0;        // difference that is within the tolerance
  double largest_float = 0.0;  // difference from what OpenMesh computes in float
  int cancelled = 0, gaps = 0, rounding = 0, unexplained = 0;
};

// `reference` has the coordinates of `mesh`, in double.
template <class Mesh, class Reference>
Line compare(Mesh &mesh, const Reference &reference, const umbilic::host_topology &topology, Method method) {
  const double tolerance = std::is_same<typename Mesh::Scalar, float>::value ? 1e-6 : 1e-12;
  const umb_weight weight = method == Method::fast ? UMB_WEIGHT_UNIFORM : UMB_WEIGHT_AREA;
  std::vector<uint8_t> statuses(mesh.n_vertices());
  umbilic::openmesh::vertex_normals(mesh, topology, weight, statuses);

  Line line;
  for (const auto vertex : mesh.vertices()) {
    const auto ours = mesh.normal(vertex);
    const Vec3d normal(ours[0], ours[1], ours[2]);
    const double difference = (normal - openmesh_normal(reference, vertex, method)).norm();
    line.largest_float = std::max(line.largest_float, (normal - openmesh_normal(mesh, vertex, method)).norm());
    if (difference <= tolerance) {
      line.largest = std::max(line.largest, difference);
      continue;
    }
    const Around around = look_around(reference, vertex, method);
    const double length = around.sum.norm();
    if (statuses[static_cast<size_t>(vertex.idx())] & (UMB_VERTEX_FALLBACK | UMB_VERTEX_DEGENERATE)) {
      line.cancelled++;
    } else if (method == Method::correct && around.gaps > 1 && (normal - around.sum / length).norm() <= tolerance) {
      line.gaps++;
    } else if (difference * length <= around.error) {
      line.rounding++;
    } else {
      line.unexplained++;
    }
  }
  return line;
}

// The same mesh in another type.
template <class To, class From>
To copy(const From &from) {
  To to;
  for (const auto vertex : from.vertices()) {
    const auto point = from.point(vertex);
    using Scalar = typename To::Scalar;
    to.add_vertex({static_cast<Scalar>(point[0]), static_cast<Scalar>(point[1]), static_cast<Scalar>(point[2])});
  }
  for (const auto face : from.faces()) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const auto vertex : from.fv_range(face)) {
      corners.push_back(vertex);
    }
    to.add_face(corners);
  }
  if (to.n_faces() != from.n_faces()) {
    throw std::runtime_error("a copy has fewer faces");
  }
  to.request_face_normals();
  to.update_face_normals();
  return to;
}

// Prints the lines of one mesh type, and tells whether all is explained.
template <class Mesh, class Reference, class Source>
bool run(const std::string &name, const Source &source) {
  auto mesh = copy<Mesh>(source);
  const auto reference = copy<Reference>(mesh);
  const auto topology = umbilic::openmesh::build_topology(mesh);
  const bool single = std::is_same<typename Mesh::Scalar, float>::value;
  bool good = true;
  for (const Method method : {Method::fast, Method::correct}) {
    if (method == Method::correct && !mesh.is_trimesh()) {
      break;
    }
    const Line line = compare(mesh, reference, topology, method);
    std::printf("%-24s %7zu %-8s %-6s %-7s %9.1e %9d %7d %8d %11d", name.c_str(), mesh.n_vertices(),
                mesh.is_trimesh() ? "triangle" : "polygon", single ? "float" : "double",
                method == Method::fast ? "fast" : "correct", line.largest, line.cancelled, line.gaps, line.rounding,
                line.unexplained);
    if (single) {
      std::printf("  %9.1e", line.largest_float);
    }
    std::printf("\n");
    good = good && line.unexplained == 0;
  }
  return good;
}

// N_CM as normals, and as colours: x, y and z as red, green and blue.
void write(PolygonMeshDouble &mesh, const std::string &path) {
  umbilic::openmesh::vertex_normals(mesh);
  mesh.request_vertex_colors();
  for (const auto vertex : mesh.vertices()) {
    const auto normal = mesh.normal(vertex);
    const auto channel = [&](size_t k) { return static_cast<unsigned char>(127.5 + 127.5 * normal[k]); };
    const OpenMesh::Vec3uc color(channel(0), channel(1), channel(2));
    mesh.set_color(vertex, OpenMesh::color_cast<PolygonMeshDouble::Color>(color));
  }
  const OpenMesh::IO::Options options = OpenMesh::IO::Options::VertexNormal | OpenMesh::IO::Options::VertexColor;
  if (!OpenMesh::IO::write_mesh(mesh, path, options)) {
    throw std::runtime_error("cannot write " + path);
  }
}

bool run_file(const std::string &path, const std::string &directory) {
  if (!std::ifstream(path)) {
    throw std::runtime_error("cannot be opened");
  }
  PolygonMeshDouble mesh;
  if (!OpenMesh::IO::read_mesh(mesh, path) || mesh.n_faces() == 0) {
    std::fprintf(stderr, "%s: OpenMesh cannot read it, left out\n", path.c_str());
    return true;
  }
  for (const auto vertex : mesh.vertices()) {
    mesh.set_point(vertex, mesh.point(vertex) / 3.0);
  }
  const std::string name = path.substr(path.find_last_of('/') + 1);
  if (!directory.empty()) {
    write(mesh, directory + "/" + name.substr(0, name.find_last_of('.')) + "_normals.ply");
  }
  const bool triangles =
      std::all_of(mesh.faces_begin(), mesh.faces_end(), [&](auto face) { return mesh.valence(face) == 3; });
  if (triangles) {
    const bool good = run<TriangleMeshDouble, TriangleMeshDouble>(name, mesh);
    return run<TriangleMeshFloat, TriangleMeshDouble>(name, mesh) && good;
  }
  const bool good = run<PolygonMeshDouble, PolygonMeshDouble>(name, mesh);
  return run<PolygonMeshFloat, PolygonMeshDouble>(name, mesh) && good;
}

}  // namespace

int main(int argc, char **argv) {
  const bool written = argc > 2 && std::string(argv[1]) == "-o";
  const std::string directory = written ? argv[2] : "";
  const int first = written ? 3 : 1;
  if (argc <= first) {
    std::fprintf(stderr, "usage: %s [-o DIRECTORY] FILE...\n", argv[0]);
    return 2;
  }
  omerr().disable();  // OpenMesh reports every face that it has to take apart
  std::printf("%-24s %7s %-8s %-6s %-7s %9s %9s %7s %8s %11s  %s\n", "mesh", "#V", "faces", "scalar", "method",
              "agreeing", "cancelled", "gaps", "rounding", "unexplained", "off in float");
  bool good = true;
  for (int index = first; index < argc; index++) {
    try {
      good = run_file(argv[index], directory) && good;
    } catch (const std::exception &exception) {
      std::fprintf(stderr, "%s: %s\n", argv[index], exception.what());
      good = false;
    }
  }
  std::printf("%s\n", good ? "All differences are explained." : "FAILED");
  return good ? 0 : 1;
}
