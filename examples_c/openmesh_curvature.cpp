/*
 * Curvatures of OpenMesh meshes by umbilic, in OpenMesh's own memory, compared with sums of OpenMesh's angles.
 *
 * Build and run, in this directory, after `cargo build --release` in the one above:
 *
 *   ln -sf libumbilic.so ../target/release/libumbilic.so.0
 *   c++ -std=c++17 -O2 -Wall -Wextra -I../include openmesh_curvature.cpp -o openmesh_curvature \
 *     -L../target/release -lumbilic -lOpenMeshCore -Wl,-rpath,../target/release
 *   ./openmesh_curvature [-o DIRECTORY] FILE...
 *
 * With -o, each mesh is written there as PLY, coloured by H: blue is negative, red positive, white 0.
 *
 * Principal curvatures and H, by umbilic's default, go to the vertex properties "v:k1", "v:k2" and "v:mean": a property
 * is an array, and umbilic writes into it. OpenMesh has no curvatures to compare these with, but it has the angles that
 * two of umbilic's integrals are made of:
 *
 *   defect  calc_sector_angle: 2 pi less the angles around a vertex, at a border pi less those of each fan;
 *           UMB_CURVATURE_ANGLE_DEFECT. In a polygon that is not flat umbilic shares out among the corners what their
 *           angles lack of (n - 2) pi. All defects have to add up to 2 pi times the Euler characteristic.
 *   mean    calc_dihedral_angle: a quarter of the sum of angle times length over the edges of a vertex;
 *           UMB_CURVATURE_NORMAL_CYCLE. In polygons calc_dihedral_angle_fast, which asks the face normals.
 *
 * They have to agree within 1e-9, `mean` relative to a quarter of the edges' lengths. Because OpenMesh's readers go
 * through float, coordinates are divided by 3 after reading, which fills all digits of a double. A vertex that differs
 * by more needs a reason, or the program fails:
 *
 *   acos       the difference is within the error of an arc cosine, as OpenMesh takes it: near 0 and 180 degrees it
 *              keeps half the digits
 *   rounding   within that and the rounding error of face normals, which is large for slivers; where two faces lie on
 *              one another, rounding says whether that is 180 degrees or -180
 *   bent       an edge is not perpendicular to the normals of polygons that are not flat: umbilic's angle is that about
 *              the edge, OpenMesh's that between the normals, and the difference is within the difference of these
 *   no length  an edge without length has no angle: OpenMesh takes 0, umbilic what lets triangles add up to 180 degrees
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
#include <vector>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <umbilic/openmesh.hpp>

namespace {

using Vec3d = OpenMesh::Vec3d;
using TriangleMesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using PolygonMesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using Property = OpenMesh::VPropHandleT<double>;

constexpr double PI = 3.14159265358979323846;
constexpr double TOLERANCE = 1e-9;
// What a term of a few operations may lose, relative to its operands.
constexpr double ROUNDING = 4.0 * std::numeric_limits<double>::epsilon();

namespace quantity = umbilic::quantity;

// A number as OpenMesh's angles have it.
struct Value {
  double value = 0.0;
  double acos = 0.0, rounding = 0.0, bent = 0.0;  // how far these may have moved it, to first order
  double unit = 1.0;                              // what a difference is relative to
  bool no_length = false;
};

// An error of the cosine moves the angle by its part of the sine, at most by its root.
double acos_error(double angle) { return ROUNDING / std::max(std::sin(std::abs(angle)), std::sqrt(ROUNDING)); }

// The angle at the end of a half-edge, in its face.
template <class Mesh>
double sector_angle(const Mesh &mesh, OpenMesh::SmartHalfedgeHandle halfedge) {
  const double angle = mesh.calc_sector_angle(halfedge);
  typename Mesh::Normal sector;
  mesh.calc_sector_normal(halfedge, sector);
  // A reflex corner of a polygon.
  const bool reflex = !mesh.is_trimesh() && mesh.valence(halfedge.face()) > 3 &&
                      sector.dot(mesh.normal(halfedge.face())) < 0.0;
  return reflex ? 2.0 * PI - angle : angle;
}

template <class Mesh>
Value angle_defect(const Mesh &mesh, OpenMesh::SmartVertexHandle vertex) {
  Value defect;
  int gaps = 0;
  for (const auto incoming : mesh.vih_range(vertex)) {
    if (incoming.is_boundary()) {
      gaps++;
      continue;
    }
    double angle = sector_angle(mesh, incoming);
    const int corners = static_cast<int>(mesh.valence(incoming.face()));
    double lack = corners == 3 ? 0.0 : (corners - 2) * PI;
    for (const auto halfedge : mesh.fh_range(incoming.face())) {
      defect.no_length = defect.no_length || mesh.calc_edge_sqr_length(halfedge) == 0.0;
      if (corners > 3) {
        const double other = sector_angle(mesh, halfedge);
        lack -= other;
        defect.acos += acos_error(other) / corners;
      }
    }
    defect.value -= angle + lack / corners;
    defect.acos += acos_error(angle);
  }
  defect.value += gaps == 0 ? 2.0 * PI : gaps * PI;
  return defect;
}

// How far rounding may turn OpenMesh's normal of a face: `a x b` is off by units in the last place of |a| |b|, and a
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
  const double error = ROUNDING * products;
  return error < 2.0 * twice_area.norm() ? error / twice_area.norm() : 2.0;
}

template <class Mesh>
Value integrated_mean(const Mesh &mesh, OpenMesh::SmartVertexHandle vertex) {
  Value mean;
  mean.unit = 0.0;
  for (const auto halfedge : mesh.voh_range(vertex)) {
    const double quarter = mesh.calc_edge_length(halfedge) / 4.0;
    mean.unit += quarter;
    if (halfedge.edge().is_boundary()) {
      continue;
    }
    const double angle =
        mesh.is_trimesh() ? mesh.calc_dihedral_angle(halfedge) : mesh.calc_dihedral_angle_fast(halfedge);
    const double turn = face_error(mesh, halfedge.face()) + face_error(mesh, halfedge.opp().face());
    mean.value += quarter * angle;
    mean.acos += quarter * acos_error(angle);
    if (!mesh.is_trimesh()) {
      const auto left = mesh.normal(halfedge.face()), right = mesh.normal(halfedge.opp().face());
      const double about = left.cross(right).dot(mesh.calc_edge_vector(halfedge)) / (4.0 * quarter);
      mean.bent += quarter * std::abs(angle - std::atan2(about, left.dot(right)));
    }
    mean.rounding += quarter * (PI - std::abs(angle) < turn + std::sqrt(ROUNDING) ? 2.0 * PI : turn);
  }
  return mean;
}

struct Line {
  double largest = 0.0;  // difference that is within the tolerance
  int acos = 0, rounding = 0, bent = 0, no_length = 0, unexplained = 0;

  void add(double ours, const Value &theirs) {
    const double difference = std::abs(ours - theirs.value);
    if (difference <= TOLERANCE * theirs.unit) {
      largest = std::max(largest, difference == 0.0 ? 0.0 : difference / theirs.unit);
    } else if (difference <= theirs.acos) {
      acos++;
    } else if (difference <= theirs.acos + theirs.rounding) {
      rounding++;
    } else if (difference <= theirs.acos + theirs.rounding + theirs.bent) {
      bent++;
    } else if (theirs.no_length) {
      no_length++;
    } else {
      unexplained++;
    }
  }

  void print(const std::string &name, const char *quantity, std::size_t vertices, bool triangles) const {
    std::printf("%-24s %7zu %-8s %-6s %9.1e %7d %8d %5d %9d %11d", name.c_str(), vertices,
                triangles ? "triangle" : "polygon", quantity, largest, acos, rounding, bent, no_length, unexplained);
  }
};

// The same mesh in another type.
template <class To, class From>
To copy(const From &from) {
  To to;
  for (const auto vertex : from.vertices()) {
    to.add_vertex(from.point(vertex));
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

// Colours by H: a tenth of the vertices are more than full red or blue.
template <class Mesh>
void write(Mesh &mesh, Property mean, const std::string &path) {
  std::vector<double> sizes;
  for (const auto vertex : mesh.vertices()) {
    sizes.push_back(std::abs(mesh.property(mean, vertex)));
  }
  const auto full = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 9 / 10);
  std::nth_element(sizes.begin(), full, sizes.end());
  const double scale = *full > 0.0 ? 1.0 / *full : 0.0;
  mesh.request_vertex_colors();
  for (const auto vertex : mesh.vertices()) {
    const double value = std::min(std::max(scale * mesh.property(mean, vertex), -1.0), 1.0);
    const auto pale = static_cast<unsigned char>(255.0 * (1.0 - std::abs(value)));
    const OpenMesh::Vec3uc color = value > 0.0 ? OpenMesh::Vec3uc(255, pale, pale) : OpenMesh::Vec3uc(pale, pale, 255);
    mesh.set_color(vertex, OpenMesh::color_cast<typename Mesh::Color>(color));
  }
  if (!OpenMesh::IO::write_mesh(mesh, path, OpenMesh::IO::Options::VertexColor)) {
    throw std::runtime_error("cannot write " + path);
  }
}

// Prints the lines of one mesh, and tells whether all is explained.
template <class Mesh>
bool run(const std::string &name, const PolygonMesh &source, const std::string &directory) {
  auto mesh = copy<Mesh>(source);
  const auto topology = umbilic::openmesh::build_topology(mesh);

  // The default: adaptive jets.
  const auto found = umbilic::openmesh::curvatures(mesh, topology);
  const Property k1 = found.k1, k2 = found.k2, mean = found.mean;
  Property defect, integral;
  umbilic::openmesh::curvatures(mesh, topology, UMB_CURVATURE_ANGLE_DEFECT, quantity::integrated_gaussian);
  umbilic::openmesh::curvatures(mesh, topology, UMB_CURVATURE_NORMAL_CYCLE, quantity::integrated_mean);
  mesh.get_property_handle(defect, "v:integrated_gauss");
  mesh.get_property_handle(integral, "v:integrated_mean");
  if (!directory.empty()) {
    write(mesh, mean, directory + "/" + name.substr(0, name.find_last_of('.')) + "_mean.ply");
  }

  Line defects, means, pointwise;
  double total = 0.0;
  // A vertex that holds several fans together counts once for each.
  long characteristic = static_cast<long>(mesh.n_faces()) - static_cast<long>(mesh.n_edges());
  for (const auto vertex : mesh.vertices()) {
    total += mesh.property(defect, vertex);
    if (mesh.is_isolated(vertex)) {
      continue;
    }
    long gaps = 0;
    for (const auto halfedge : mesh.voh_range(vertex)) {
      gaps += halfedge.is_boundary();
    }
    characteristic += std::max(gaps, 1L);
    defects.add(mesh.property(defect, vertex), angle_defect(mesh, vertex));
    means.add(mesh.property(integral, vertex), integrated_mean(mesh, vertex));
    Value half;
    half.value = (mesh.property(k1, vertex) + mesh.property(k2, vertex)) / 2.0;
    half.unit = std::abs(mesh.property(k1, vertex)) + std::abs(mesh.property(k2, vertex));
    pointwise.add(mesh.property(mean, vertex), half);
  }
  const double gauss_bonnet = std::abs(total - 2.0 * PI * static_cast<double>(characteristic));
  defects.print(name, "defect", mesh.n_vertices(), mesh.is_trimesh());
  std::printf(" %12.1e\n", gauss_bonnet);
  means.print(name, "mean", mesh.n_vertices(), mesh.is_trimesh());
  std::printf("\n");
  return defects.unexplained + means.unexplained + pointwise.unexplained == 0 &&
         gauss_bonnet <= 1e-12 * static_cast<double>(mesh.n_vertices());
}

bool run_file(const std::string &path, const std::string &directory) {
  if (!std::ifstream(path)) {
    throw std::runtime_error("cannot be opened");
  }
  PolygonMesh mesh;
  if (!OpenMesh::IO::read_mesh(mesh, path) || mesh.n_faces() == 0) {
    std::fprintf(stderr, "%s: OpenMesh cannot read it, left out\n", path.c_str());
    return true;
  }
  for (const auto vertex : mesh.vertices()) {
    mesh.set_point(vertex, mesh.point(vertex) / 3.0);
  }
  const std::string name = path.substr(path.find_last_of('/') + 1);
  const bool triangles =
      std::all_of(mesh.faces_begin(), mesh.faces_end(), [&](auto face) { return mesh.valence(face) == 3; });
  return triangles ? run<TriangleMesh>(name, mesh, directory) : run<PolygonMesh>(name, mesh, directory);
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
  std::printf("%-24s %7s %-8s %-6s %9s %7s %8s %5s %9s %11s %12s\n", "mesh", "#V", "faces", "", "agreeing", "acos",
              "rounding", "bent", "no length", "unexplained", "Gauss-Bonnet");
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
