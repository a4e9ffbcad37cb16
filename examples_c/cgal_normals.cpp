/*
 * Vertex normals of CGAL surface meshes by umbilic, in CGAL's own memory, compared with CGAL's own.
 *
 * Build and run, in this directory, after `cargo build --release` in the one above:
 *
 *   ln -sf libumbilic.so ../target/release/libumbilic.so.0
 *   c++ -std=c++17 -O2 -Wall -Wextra -I../include cgal_normals.cpp -o cgal_normals \
 *     -L../target/release -lumbilic -lgmp -lmpfr -Wl,-rpath,../target/release
 *   ./cgal_normals [-o DIRECTORY] FILE...
 *
 * With -o, each mesh is written there as PLY, with N_CM as colours.
 *
 * Each mesh is tried with the kernels Simple_cartesian<double> and EPICK, whose points are three doubles. umbilic's
 * normals have to agree within 1e-12 with the same averages of what CGAL says of the faces:
 *
 *   uniform  of PMP::compute_face_normal
 *   area     of the same by the area, PMP::face_area for triangles
 *   angle    of the same by CGAL::approximate_angle
 *
 * A vertex that differs by more needs a reason, or the program fails:
 *
 *   cancelled  the faces' normals add up to nothing: umbilic says so in its status and takes another weight
 *   rounding   the difference is within the rounding error of CGAL's formulas, which is large for slivers and for sums
 *              short against their terms
 *   acos       the same, with the error of CGAL::approximate_angle, which takes an arc cosine: near 0 and 180 degrees
 *              that keeps half the digits
 *
 * CGAL's own vertex normal, PMP::compute_vertex_normals, is defined differently: it is the middle of the smallest cap
 * that holds all face normals. Its mean and largest angle to umbilic's uniform normal are printed, not judged.
 */
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

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/PLY.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <umbilic/cgal.hpp>

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

constexpr double PI = 3.14159265358979323846;
constexpr double TOLERANCE = 1e-12;
// What a term of a few operations may lose, relative to its operands.
constexpr double ROUNDING = 4.0 * std::numeric_limits<double>::epsilon();

// A property of the vertices, which CGAL keeps as one array.
template <class Mesh, class Vector>
using VectorMap = typename Mesh::template Property_map<typename Mesh::Vertex_index, Vector>;

template <class Vector>
double length(const Vector &vector) {
  return std::sqrt(vector.squared_length());
}

template <class Vector>
double degrees_between(const Vector &a, const Vector &b) {
  return std::atan2(length(CGAL::cross_product(a, b)), a * b) * 180.0 / PI;
}

// What CGAL says of a face.
template <class Vector>
struct Face {
  Vector normal;
  double area;
  double products = 0.0;  // |a| |b| of the cross products that CGAL takes: their error is in units of its last place
};

template <class Mesh, class Vector>
Face<Vector> look_at_face(const Mesh &mesh, typename Mesh::Face_index index) {
  Face<Vector> face{PMP::compute_face_normal(index, mesh), 0.0};
  std::vector<typename Mesh::Point> corners;
  for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(index))) {
    corners.push_back(mesh.point(vertex));
  }
  Vector twice_area(0.0, 0.0, 0.0);
  for (std::size_t k = 1; k + 1 < corners.size(); k++) {
    const Vector a = corners[k] - corners[0], b = corners[k + 1] - corners[0];
    twice_area = twice_area + CGAL::cross_product(a, b);
    const double longest = std::max(length(a), length(b));
    face.products += longest * std::max(length(b - a), std::min(length(a), length(b)));
  }
  // PMP::face_area is for triangles.
  face.area = corners.size() == 3 ? PMP::face_area(index, mesh) : 0.5 * length(twice_area);
  return face;
}

// A vertex as CGAL sees it.
template <class Vector>
struct Around {
  Vector sum{0.0, 0.0, 0.0};
  double rounding = 0.0, acos = 0.0;  // what these may have done to the sum, to first order
};

template <class Mesh, class Vector>
Around<Vector> look_around(const Mesh &mesh, const std::vector<Face<Vector>> &faces,
                           typename Mesh::Vertex_index vertex, umb_weight weight) {
  Around<Vector> around;
  if (mesh.is_isolated(vertex)) {
    return around;
  }
  for (const auto halfedge : mesh.halfedges_around_target(mesh.halfedge(vertex))) {
    if (mesh.is_border(halfedge)) {
      continue;
    }
    const Face<Vector> &face = faces[mesh.face(halfedge)];
    double factor = 1.0;
    if (weight == UMB_WEIGHT_AREA) {
      factor = face.area;
    } else if (weight == UMB_WEIGHT_ANGLE) {
      const Vector a = mesh.point(mesh.target(mesh.next(halfedge))) - mesh.point(vertex);
      const Vector b = mesh.point(mesh.source(halfedge)) - mesh.point(vertex);
      factor = CGAL::approximate_angle(a, b) * PI / 180.0;
      // An error of the cosine moves the angle by its part of the sine, at most by its root.
      around.acos += ROUNDING / std::max(std::sin(factor), std::sqrt(ROUNDING));
      if (CGAL::cross_product(a, b) * face.normal < 0.0) {
        factor = 2.0 * PI - factor;  // a reflex corner of a polygon
      }
    }
    around.sum = around.sum + face.normal * factor;
    // A unit vector is never off by more than 2, an area times one by its share of the products.
    const double error = ROUNDING * face.products;
    const double relative = error < 2.0 * face.area ? error / face.area : 2.0;
    around.rounding += weight == UMB_WEIGHT_AREA ? error : factor * relative;
  }
  return around;
}

struct Line {
  double largest = 0.0;  // difference that is within the tolerance
  int cancelled = 0, rounding = 0, acos = 0, unexplained = 0;
};

template <class Mesh, class Vector>
Line compare(const Mesh &mesh, const std::vector<Face<Vector>> &faces, umb_weight weight,
             const VectorMap<Mesh, Vector> &ours, const std::vector<uint8_t> &statuses) {
  Line line;
  for (const auto vertex : mesh.vertices()) {
    const Around<Vector> around = look_around(mesh, faces, vertex, weight);
    const double sum_length = length(around.sum);
    const Vector theirs = sum_length > 0.0 ? around.sum / sum_length : around.sum;
    const double difference = length(ours[vertex] - theirs);
    if (difference <= TOLERANCE) {
      line.largest = std::max(line.largest, difference);
    } else if (statuses[vertex] & (UMB_VERTEX_FALLBACK | UMB_VERTEX_DEGENERATE)) {
      line.cancelled++;
    } else if (difference * sum_length <= around.rounding) {
      line.rounding++;
    } else if (weight == UMB_WEIGHT_ANGLE && difference * sum_length <= around.rounding + around.acos) {
      line.acos++;
    } else {
      line.unexplained++;
    }
  }
  return line;
}

// N_CM as colours: x, y and z as red, green and blue. CGAL writes the property of this name.
template <class Mesh>
void write(Mesh &mesh, const umbilic::host_topology &topology, const std::string &path) {
  const auto normals = umbilic::cgal::vertex_normals(mesh, topology);
  auto colors = mesh.template add_property_map<typename Mesh::Vertex_index, CGAL::IO::Color>("v:color").first;
  for (const auto vertex : mesh.vertices()) {
    const auto channel = [&](int k) { return static_cast<unsigned char>(127.5 + 127.5 * normals[vertex][k]); };
    colors[vertex] = CGAL::IO::Color(channel(0), channel(1), channel(2));
  }
  std::ofstream file(path, std::ios::binary);
  CGAL::IO::set_binary_mode(file);
  if (!CGAL::IO::write_PLY(file, mesh)) {
    throw std::runtime_error("cannot write " + path);
  }
}

// Prints the lines of one kernel, and tells whether all is explained.
template <class Kernel>
bool run(const std::string &path, const char *kernel, const std::string &directory) {
  using Vector = typename Kernel::Vector_3;
  using Mesh = CGAL::Surface_mesh<typename Kernel::Point_3>;
  Mesh mesh;
  // The second way merges and doubles vertices and turns faces around until a half-edge structure can hold them.
  const bool read = CGAL::IO::read_polygon_mesh(path, mesh) || PMP::IO::read_polygon_mesh(path, mesh);
  if (!read || mesh.number_of_faces() == 0) {
    std::fprintf(stderr, "%s: CGAL cannot read it, left out\n", path.c_str());
    return true;
  }
  mesh.collect_garbage();

  const auto topology = umbilic::cgal::build_topology(mesh);
  std::vector<Face<Vector>> faces;
  for (const auto face : mesh.faces()) {
    faces.push_back(look_at_face<Mesh, Vector>(mesh, face));
  }
  const std::string name = path.substr(path.find_last_of('/') + 1);
  if (!directory.empty()) {
    write(mesh, topology, directory + "/" + name.substr(0, name.find_last_of('.')) + "_normals.ply");
  }
  const struct {
    umb_weight weight;
    const char *name;
  } weights[] = {{UMB_WEIGHT_UNIFORM, "uniform"}, {UMB_WEIGHT_AREA, "area"}, {UMB_WEIGHT_ANGLE, "angle"}};
  bool good = true;
  for (const auto &weight : weights) {
    std::vector<uint8_t> statuses(mesh.number_of_vertices());
    const VectorMap<Mesh, Vector> normals = umbilic::cgal::vertex_normals(mesh, topology, weight.weight, statuses);
    const Line line = compare(mesh, faces, weight.weight, normals, statuses);
    std::printf("%-24s %7zu %7zu %-6s %-8s %9.1e %9d %8d %5d %11d\n", name.c_str(),
                static_cast<std::size_t>(mesh.number_of_vertices()), static_cast<std::size_t>(mesh.number_of_faces()),
                kernel, weight.name, line.largest, line.cancelled, line.rounding, line.acos, line.unexplained);
    good = good && line.unexplained == 0;
  }

  auto most_visible = mesh.template add_property_map<typename Mesh::Vertex_index, Vector>("v:most_visible").first;
  PMP::compute_vertex_normals(mesh, most_visible);
  const VectorMap<Mesh, Vector> normals = umbilic::cgal::vertex_normals(mesh, topology, UMB_WEIGHT_UNIFORM);
  double worst = 0.0, sum = 0.0;
  for (const auto vertex : mesh.vertices()) {
    const double angle = degrees_between(normals[vertex], most_visible[vertex]);
    worst = std::max(worst, angle);
    sum += angle;
  }
  std::printf("%-40s %-6s compute_vertex_normals: %.3g degrees from uniform, at most %.3g\n", name.c_str(), kernel,
              sum / mesh.number_of_vertices(), worst);
  return good;
}

bool run_file(const std::string &path, const std::string &directory) {
  if (!std::ifstream(path)) {
    throw std::runtime_error("cannot be opened");
  }
  const bool good = run<CGAL::Simple_cartesian<double>>(path, "simple", directory);
  return run<CGAL::Exact_predicates_inexact_constructions_kernel>(path, "EPICK", "") && good;
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
  std::printf("%-24s %7s %7s %-6s %-8s %9s %9s %8s %5s %11s\n", "mesh", "#V", "#F", "kernel", "weight", "agreeing",
              "cancelled", "rounding", "acos", "unexplained");
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
