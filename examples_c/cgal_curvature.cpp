/*
 * Curvatures of CGAL surface meshes by umbilic's jets, in CGAL's own memory, compared with CGAL's own jets.
 *
 * Build and run, in this directory, after `cargo build --release` in the one above:
 *
 *   ln -sf libumbilic.so ../target/release/libumbilic.so.0
 *   c++ -std=c++17 -O2 -Wall -Wextra -DCGAL_EIGEN3_ENABLED -I../include -isystem /usr/include/eigen3 \
 *     cgal_curvature.cpp -o cgal_curvature \
 *     -L../target/release -lumbilic -lgmp -lmpfr -Wl,-rpath,../target/release
 *   ./cgal_curvature [-o DIRECTORY] FILE...
 *
 * With -o, each mesh is written there as PLY, coloured by H of umbilic's default, adaptive jets: blue is negative, red positive, white 0.
 *
 * CGAL::Monge_via_jet_fitting takes points. Here it is handed each vertex and its two rings (degrees 2 and 3) or three
 * rings (degree 4) of vertices that share a face, as umbilic's topology has them. In CGAL a surface that bends towards
 * its normal is curved positively, in umbilic one that bends away from it, as a sphere does from its outward normals:
 * umbilic's k1 is CGAL's k2 with the other sign, and so are the directions exchanged.
 *
 * Differences of k1 and k2, and that of the directions times k1 - k2, are taken relative to the curvedness; normals are
 * compared as they are. They have to agree within 1e-10 where CGAL's condition number is below 1e4, elsewhere within
 * 1e-8, or what rounding may do at that condition if that is more. A vertex that differs by more needs a reason, or the
 * program fails:
 *
 *   isolated   no face uses the vertex, and umbilic says so in its status
 *   flat       the curvatures are those of a plane to rounding, on both sides
 *   ambiguous  the points vary as little in one direction as in another, and rounding says which plane they are fitted
 *              over
 *   cut        the neighbourhood has more than 255 vertices, or one with more than 64 ring entries: umbilic takes fewer
 *   widened    umbilic widened the neighbourhood and says so; CGAL agrees on one of the next four rings
 *   fallback   umbilic took something simpler and says so, because there are no more points than coefficients (few),
 *              because they hardly determine a polynomial, by CGAL's condition number (dependent), because CGAL's
 *              normal is more than 75 degrees from that of the faces (turned), or because the points vary across their
 *              plane nearly as much as in it (thick)
 */

// CGAL's default are closed formulas of eigenvectors, which lose half the digits.
#define DO_NOT_USE_EIGEN_COMPUTEDIRECT_FOR_DIAGONALIZATION

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
#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/PLY.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <umbilic/cgal.hpp>

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Fitting = CGAL::Monge_via_jet_fitting<Kernel>;

static_assert(umbilic::vector_traits<Point>::size == 3 && umbilic::vector_traits<Vector>::size == 3,
              "points and vectors are three doubles in a row; those of a lazy kernel would be converted");

constexpr double WELL_CONDITIONED = 1e4;
// umbilic calls columns dependent below 2^-16 of their length, which is at least as much in CGAL's condition number; and
// takes no condition beyond 1e6, in the Frobenius norm and with K columns of length 1: for CGAL's number, in the spectral
// norm and with other units, that may be less by K, and by the root of K, times.
double dependent(std::size_t coefficients) {
  return std::min(65536.0, 1e6 / std::pow(static_cast<double>(coefficients), 1.5));
}
// From this ratio of the two smallest variances on, umbilic does not believe in the plane.
constexpr double THICK = 0.75;
// What a term of a few operations may lose, relative to its operands.
constexpr double ROUNDING = 4.0 * std::numeric_limits<double>::epsilon();

// Property maps of the mesh, each of which is one array; umbilic writes into them.
struct Curvatures {
  Mesh::Property_map<Vertex, double> k1, k2;
  Mesh::Property_map<Vertex, Vector> direction1, normal;
  Mesh::Property_map<Vertex, uint8_t> status;
  Mesh::Property_map<Vertex, Vector> face_normal;  // by area: tells the two sides of the surface apart
};

struct Jets {
  uint32_t degree, rings;
  std::size_t coefficients() const { return (degree + 1) * (degree + 2) / 2; }
};

Curvatures umbilic_curvatures(Mesh &mesh, const umbilic::host_topology &topology, const Jets &jets) {
  namespace quantity = umbilic::quantity;
  Curvatures found;
  found.face_normal = umbilic::cgal::vertex_normals(mesh, topology, UMB_WEIGHT_AREA);
  umbilic::curvature_options options(UMB_CURVATURE_JET);
  options.degree = jets.degree;
  options.rings = jets.rings;
  options.normals = umbilic::points(found.face_normal.data(), mesh.number_of_vertices());
  const auto principal =
      umbilic::cgal::curvatures(mesh, topology, options,
                                quantity::k1 | quantity::k2 | quantity::direction1 | quantity::normal | quantity::status);
  found.k1 = principal.k1;
  found.k2 = principal.k2;
  found.direction1 = principal.dir1;
  found.normal = mesh.property_map<Vertex, Vector>("v:fit_normal").first;
  found.status = mesh.property_map<Vertex, uint8_t>("v:curvature_status").first;
  return found;
}

// Colours by H: a tenth of the vertices are more than full red or blue. CGAL writes the property of this name.
void write(Mesh &mesh, const umbilic::host_topology &topology, const std::string &path) {
  const auto mean = umbilic::cgal::curvatures(mesh, topology).mean;
  std::vector<double> sizes;
  for (const auto vertex : mesh.vertices()) {
    sizes.push_back(std::abs(mean[vertex]));
  }
  const auto full = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 9 / 10);
  std::nth_element(sizes.begin(), full, sizes.end());
  const double scale = *full > 0.0 ? 1.0 / *full : 0.0;
  auto colors = mesh.add_property_map<Vertex, CGAL::IO::Color>("v:color").first;
  for (const auto vertex : mesh.vertices()) {
    const double value = std::min(std::max(scale * mean[vertex], -1.0), 1.0);
    const auto pale = static_cast<unsigned char>(255.0 * (1.0 - std::abs(value)));
    colors[vertex] = value > 0.0 ? CGAL::IO::Color(255, pale, pale) : CGAL::IO::Color(pale, pale, 255);
  }
  std::ofstream file(path, std::ios::binary);
  CGAL::IO::set_binary_mode(file);
  if (!CGAL::IO::write_PLY(file, mesh)) {
    throw std::runtime_error("cannot write " + path);
  }
}

// The vertices around a vertex, ring after ring: those that share a face with one of the ring before.
class Neighbourhood {
 public:
  Neighbourhood(const Mesh &mesh, umbilic::topology_view topology)
      : mesh_(mesh),
        triangles_(CGAL::is_triangle_mesh(mesh)),
        offsets_(topology.ring_offsets()),
        neighbours_(topology.ring_neighbours()),
        seen_(mesh.number_of_vertices(), 0) {}

  void start(Vertex vertex) {
    gather_++;
    members_.clear();
    expanded_ = 0;
    thinned_ = false;
    add(vertex.idx());
  }

  void widen() {
    for (const std::size_t last = members_.size(); expanded_ < last; expanded_++) {
      const uint32_t vertex = members_[expanded_];
      for (uint32_t entry = offsets_[vertex]; entry < offsets_[vertex + 1]; entry++) {
        add(neighbours_[entry]);
      }
      thinned_ = thinned_ || offsets_[vertex + 1] - offsets_[vertex] > 64;
      if (triangles_ || mesh_.is_isolated(Vertex(vertex))) {
        continue;  // the corners of a triangle are neighbours
      }
      for (const auto face : mesh_.faces_around_target(mesh_.halfedge(Vertex(vertex)))) {
        if (face != Mesh::null_face()) {
          for (const auto corner : mesh_.vertices_around_face(mesh_.halfedge(face))) {
            add(corner.idx());
          }
        }
      }
    }
  }

  std::size_t size() const { return members_.size(); }  // with the vertex itself
  bool cut() const { return thinned_ || members_.size() > 256; }

  // Relative to the vertex, which is the first: CGAL takes sums of squares of coordinates as they come.
  std::vector<Point> points() const {
    std::vector<Point> points;
    for (const uint32_t member : members_) {
      points.push_back(CGAL::ORIGIN + (mesh_.point(Vertex(member)) - mesh_.point(Vertex(members_[0]))));
    }
    return points;
  }

 private:
  void add(uint32_t vertex) {
    if (seen_[vertex] != gather_) {
      seen_[vertex] = gather_;
      members_.push_back(vertex);
    }
  }

  const Mesh &mesh_;
  const bool triangles_;
  const umbilic::span<const uint32_t> offsets_, neighbours_;
  std::vector<uint32_t> seen_, members_;
  uint32_t gather_ = 0;
  std::size_t expanded_ = 0;
  bool thinned_ = false;
};

double length(const Vector &vector) { return std::sqrt(vector.squared_length()); }

// What CGAL says of a neighbourhood, in umbilic's signs.
struct Fit {
  double k1, k2, curvedness;
  Vector direction1, normal;
  double condition;
  double size;   // of the neighbourhood
  double gap;    // between the two smallest variances, relative to the largest
  bool turned;   // the normal is more than 75 degrees from that of the faces
  bool thick;    // the points vary nearly as much across the plane as in it

  Fit(const std::vector<Point> &points, const Jets &jets, const Vector &face_normal) {
    Fitting fitting;
    auto form = fitting(points.begin(), points.end(), jets.degree, 2);
    const auto least = fitting.pca_basis(2).second;
    const Vector height(least.x(), least.y(), least.z());
    const double agreement = form.normal_direction() * face_normal;
    const double side = (height * face_normal) * (height * form.normal_direction());
    turned = agreement * side < 0.0 || std::abs(agreement) < 0.25;
    form.comply_wrt_given_normal(face_normal);
    k1 = -form.principal_curvatures(1);
    k2 = -form.principal_curvatures(0);
    curvedness = std::sqrt((k1 * k1 + k2 * k2) / 2.0);
    direction1 = form.minimal_principal_direction();
    normal = form.normal_direction();
    condition = fitting.condition_number();
    gap = (fitting.pca_basis(1).first - fitting.pca_basis(2).first) / fitting.pca_basis(0).first;
    thick = fitting.pca_basis(2).first >= THICK * (1.0 - 1e-9) * fitting.pca_basis(1).first;
    size = 0.0;
    for (const Point &point : points) {
      size = std::max(size, length(point - CGAL::ORIGIN));
    }
  }

  bool well_conditioned() const { return condition < WELL_CONDITIONED; }
  // What rounding may do to heights, relative to the size; beyond a condition of 1e9 nothing is left to compare.
  double rounding() const { return 4.0 * ROUNDING * std::min(condition, 1e9); }
  double tolerance() const { return well_conditioned() ? 1e-10 : std::max(1e-8, rounding()); }
};

struct Difference {
  double curvature;  // 1/length
  double normal;

  Difference(const Curvatures &ours, Vertex vertex, const Fit &theirs) {
    // The error of a direction is that of the shape operator by the difference of its eigenvalues.
    const double turn = length(CGAL::cross_product(ours.direction1[vertex], theirs.direction1));
    curvature = std::max({std::abs(ours.k1[vertex] - theirs.k1), std::abs(ours.k2[vertex] - theirs.k2),
                          (theirs.k1 - theirs.k2) * turn});
    normal = length(ours.normal[vertex] - theirs.normal);
  }

  double relative(const Fit &theirs) const {
    return std::max(normal, curvature == 0.0 ? 0.0 : curvature / theirs.curvedness);
  }

  bool is_flat(const Fit &theirs) const {
    return normal <= theirs.tolerance() &&
           std::max(curvature, theirs.curvedness) * theirs.size <= theirs.rounding();
  }
};

struct Line {
  double largest = 0.0, largest_loose = 0.0;  // differences within the tolerance: well conditioned, and not
  int isolated = 0, flat = 0, ambiguous = 0, cut = 0, widened = 0, few = 0, dependent = 0, turned = 0, thick = 0;
  int unexplained = 0;
};

// Whether CGAL agrees after up to four more rings, as umbilic widens a neighbourhood.
bool agrees_wider(const Curvatures &ours, Vertex vertex, const Jets &jets, Neighbourhood &neighbourhood) {
  for (int more = 0; more < 4; more++) {
    neighbourhood.widen();
    if (neighbourhood.size() > jets.coefficients()) {
      const Fit theirs(neighbourhood.points(), jets, ours.face_normal[vertex]);
      const Difference difference(ours, vertex, theirs);
      if (difference.is_flat(theirs) || difference.relative(theirs) <= theirs.tolerance()) {
        return true;
      }
    }
  }
  return neighbourhood.cut();
}

Line compare(const Mesh &mesh, umbilic::topology_view topology, const Jets &jets, const Curvatures &ours) {
  Neighbourhood neighbourhood(mesh, topology);
  Line line;
  for (const auto vertex : mesh.vertices()) {
    const uint8_t status = ours.status[vertex];
    if (mesh.is_isolated(vertex) && status & UMB_VERTEX_ISOLATED) {
      line.isolated++;
      continue;
    }
    neighbourhood.start(vertex);
    for (uint32_t ring = 0; ring < jets.rings; ring++) {
      neighbourhood.widen();
    }
    const bool simpler = status & (UMB_VERTEX_FALLBACK | UMB_VERTEX_DEGENERATE);
    if (neighbourhood.size() <= jets.coefficients()) {
      if (simpler) {
        line.few++;
      } else if (status & UMB_VERTEX_WIDENED && agrees_wider(ours, vertex, jets, neighbourhood)) {
        line.widened++;
      } else {
        line.unexplained++;
      }
      continue;
    }
    const Fit theirs(neighbourhood.points(), jets, ours.face_normal[vertex]);
    const Difference difference(ours, vertex, theirs);
    const double relative = difference.relative(theirs), tolerance = theirs.tolerance();
    if (relative <= tolerance && !(status & UMB_VERTEX_WIDENED) && !simpler) {
      double &largest = theirs.well_conditioned() ? line.largest : line.largest_loose;
      largest = std::max(largest, relative);
    } else if (neighbourhood.cut()) {
      line.cut++;
    } else if (simpler) {
      if (theirs.turned) {
        line.turned++;
      } else if (theirs.condition >= dependent(jets.coefficients())) {
        line.dependent++;
      } else if (theirs.thick) {
        line.thick++;
      } else {
        line.unexplained++;
      }
    } else if (status & UMB_VERTEX_WIDENED) {
      if (agrees_wider(ours, vertex, jets, neighbourhood)) {
        line.widened++;
      } else {
        line.unexplained++;
      }
    } else if (difference.is_flat(theirs)) {
      line.flat++;
    } else if (ROUNDING > tolerance * theirs.gap) {
      line.ambiguous++;
    } else {
      line.unexplained++;
    }
  }
  return line;
}

// Prints the lines of one mesh, and tells whether all is explained.
bool run(const std::string &path, const std::string &directory) {
  if (!std::ifstream(path)) {
    throw std::runtime_error("cannot be opened");
  }
  Mesh mesh;
  // The second way merges and doubles vertices and turns faces around until a half-edge structure can hold them.
  const bool read = CGAL::IO::read_polygon_mesh(path, mesh) || PMP::IO::read_polygon_mesh(path, mesh);
  if (!read || mesh.number_of_faces() == 0) {
    std::fprintf(stderr, "%s: CGAL cannot read it, left out\n", path.c_str());
    return true;
  }
  mesh.collect_garbage();

  const auto topology = umbilic::cgal::build_topology(mesh);
  const std::string name = path.substr(path.find_last_of('/') + 1);
  if (!directory.empty()) {
    write(mesh, topology, directory + "/" + name.substr(0, name.find_last_of('.')) + "_mean.ply");
  }
  bool good = true;
  for (const Jets jets : {Jets{2, 2}, Jets{3, 2}, Jets{4, 3}}) {
    const Curvatures curvatures = umbilic_curvatures(mesh, topology, jets);
    const Line line = compare(mesh, topology, jets, curvatures);
    std::printf("%-24s %7zu %6u %5u %9.1e %9.1e %8d %6d %9d %5d %7d %5d %9d %6d %5d %11d\n", name.c_str(),
                static_cast<std::size_t>(mesh.number_of_vertices()), jets.degree, jets.rings, line.largest,
                line.largest_loose, line.isolated, line.flat, line.ambiguous, line.cut, line.widened, line.few,
                line.dependent, line.turned, line.thick, line.unexplained);
    good = good && line.unexplained == 0;
  }
  return good;
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
  std::printf("%-24s %7s %6s %5s %9s %9s %8s %6s %9s %5s %7s %5s %9s %6s %5s %11s\n", "mesh", "#V", "degree",
              "rings", "agreeing", "cond>1e4", "isolated", "flat", "ambiguous", "cut", "widened", "few", "dependent",
              "turned", "thick", "unexplained");
  bool good = true;
  for (int index = first; index < argc; index++) {
    try {
      good = run(argv[index], directory) && good;
    } catch (const std::exception &exception) {
      std::fprintf(stderr, "%s: %s\n", argv[index], exception.what());
      good = false;
    }
  }
  std::printf("%s\n", good ? "All differences are explained." : "FAILED");
  return good ? 0 : 1;
}
