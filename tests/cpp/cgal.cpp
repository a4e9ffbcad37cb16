// umbilic/cgal.hpp on Surface_mesh over four kernels, whole and with removed elements, and on other graphs.
#include "umbilic/cgal.hpp"

#include <cmath>
#include <map>
#include <random>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include "allocations.hpp"
#include "check.hpp"

namespace {

namespace uc = umbilic::cgal;

constexpr double PI = 3.14159265358979323846;

using Simple = CGAL::Simple_cartesian<double>;
using Single = CGAL::Simple_cartesian<float>;
using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;
template <class Kernel>
using Mesh = CGAL::Surface_mesh<typename Kernel::Point_3>;

static_assert(umbilic::vector_traits<Simple::Point_3>::size == 3 && umbilic::vector_traits<Epick::Vector_3>::size == 3);
static_assert(umbilic::vector_traits<Epeck::Point_3>::size == 0 && umbilic::vector_traits<Single::Point_3>::size == 3);
static_assert(std::is_constructible_v<umbilic::points, const std::vector<Epick::Point_3> &>);
static_assert(!std::is_constructible_v<umbilic::points, const std::vector<Epeck::Point_3> &>);
// Maps of other elements are not vertices'.
using Faces = Mesh<Simple>::Property_map<Mesh<Simple>::Face_index, double>;
using Vertices = Mesh<Simple>::Property_map<Mesh<Simple>::Vertex_index, double>;
static_assert(!uc::detail::is_array<Mesh<Simple>, Faces>() && !uc::detail::TAKES_VERTICES<Mesh<Simple>, Faces>);
static_assert(uc::detail::is_array<Mesh<Simple>, Vertices>() && uc::detail::TAKES_VERTICES<Mesh<Simple>, Vertices>);

// Without a map there is nothing to compute.
template <class Graph, class = void>
constexpr bool COMPUTES_NOTHING = false;
template <class Graph>
constexpr bool COMPUTES_NOTHING<Graph, std::void_t<decltype(uc::curvatures(std::declval<const Graph &>(), std::declval<const umbilic::host_topology &>(),
                                                                           umbilic::curvature_options()))>> = true;
static_assert(!COMPUTES_NOTHING<CGAL::Polyhedron_3<Simple>>);

// A sphere of radius 2, of quads or triangles.
template <class Graph>
Graph sphere(bool triangles, int around = 32, int across = 16) {
  using Point = typename Graph::Point;
  Graph mesh;
  std::vector<typename Graph::Vertex_index> ring;
  for (int i = 1; i < across; i++) {
    for (int j = 0; j < around; j++) {
      const double down = PI * i / across, turn = 2 * PI * j / around;
      const double x = 2 * std::sin(down) * std::cos(turn), y = 2 * std::sin(down) * std::sin(turn);
      if constexpr (std::is_same_v<typename CGAL::Kernel_traits<Point>::Kernel, Single>) {
        ring.push_back(mesh.add_vertex(Point(static_cast<float>(x), static_cast<float>(y), static_cast<float>(2 * std::cos(down)))));
      } else {
        ring.push_back(mesh.add_vertex(Point(x, y, 2 * std::cos(down))));
      }
    }
  }
  ring.push_back(mesh.add_vertex(Point(0, 0, 2)));
  ring.push_back(mesh.add_vertex(Point(0, 0, -2)));
  const auto at = [&](int i, int j) { return ring[static_cast<std::size_t>(i * around + j % around)]; };
  for (int j = 0; j < around; j++) {
    mesh.add_face(ring[ring.size() - 2], at(0, j), at(0, j + 1));
    for (int i = 0; i + 2 < across; i++) {
      if (triangles) {
        mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
        mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
      } else {
        mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
    mesh.add_face(at(across - 2, j + 1), at(across - 2, j), ring[ring.size() - 1]);
  }
  return mesh;
}

template <class Vector>
std::array<double, 3> plain(const Vector &vector) {
  return {CGAL::to_double(vector.x()), CGAL::to_double(vector.y()), CGAL::to_double(vector.z())};
}
template <class A, class B>
double product(const A &a, const B &b) {
  const auto p = plain(a), q = plain(b);
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

template <class Kernel>
void whole(bool triangles) {
  auto mesh = sphere<Mesh<Kernel>>(triangles);
  std::vector<std::uint8_t> statuses(mesh.number_of_vertices(), 99);
  const auto normals = uc::vertex_normals(mesh, UMB_WEIGHT_MAX, statuses);
  const auto rings = uc::build_topology(mesh);
  CHECK(rings.face_count() == mesh.number_of_faces() && rings.stats().edge_count == mesh.number_of_edges() && !rings.has_gaps());
  const auto found = uc::curvatures(mesh, rings);
  for (const auto vertex : mesh.vertices()) {
    CHECK(statuses[vertex] == 0);
    const auto &point = mesh.point(vertex);
    CHECK(std::abs(product(normals[vertex], point) / 2 - 1) < (triangles ? 1e-6 : 1e-3));
    CHECK(std::abs(found.k1[vertex] - 0.5) < 5e-3 && std::abs(found.k2[vertex] - 0.5) < 5e-3);
    CHECK(std::abs(found.mean[vertex] - 0.5) < 5e-3 && std::abs(found.gauss[vertex] - 0.25) < 5e-3);
    CHECK(std::abs(product(found.dir1[vertex], found.dir2[vertex])) < 1e-6);
  }
  using Vertex = typename Mesh<Kernel>::Vertex_index;
  CHECK((mesh.template property_map<Vertex, typename Kernel::Vector_3>("v:normal").second));
  // Found again; what the method has.
  const auto again = uc::curvatures(mesh, UMB_CURVATURE_ANGLE_DEFECT);
  CHECK(&again.gauss[Vertex(0)] == &found.gauss[Vertex(0)] && !again.k1 && !again.dir1);
  uc::curvatures(mesh, rings, {}, umbilic::quantity::curvedness | umbilic::quantity::status | umbilic::quantity::normal);
  const auto status = mesh.template property_map<Vertex, std::uint8_t>("v:curvature_status");
  CHECK(status.second && status.first[Vertex(9)] == 0);

  // With a topology that stands, nothing is copied (names of properties are strings), unless coordinates are not numbers.
  const std::size_t before = allocated_bytes;
  uc::vertex_normals(mesh, rings, UMB_WEIGHT_MAX);
  uc::curvatures(mesh, rings);
  CHECK((allocated_bytes - before < 10 * mesh.number_of_vertices()) == !std::is_same_v<Kernel, Epeck>);

  // To the bit what the library computes from the same numbers elsewhere.
  std::vector<std::array<double, 3>> copied;
  for (const auto vertex : mesh.vertices()) copied.push_back(plain(mesh.point(vertex)));
  if constexpr (!std::is_same_v<Kernel, Single>) {
    const auto elsewhere = umbilic::vertex_normals(rings, copied, UMB_WEIGHT_MAX);
    for (const auto vertex : mesh.vertices()) CHECK(plain(normals[vertex]) == elsewhere[vertex]);
  }
  const auto segments = uc::segment(mesh, umbilic::feature_options());
  CHECK(segments.count() == 1);
  const auto areas = segments.areas(uc::polygons_of(mesh), copied);
  CHECK(std::abs(areas[0] - 16 * PI) < 0.02 * 16 * PI);

  // Other points: the same, twice as large.
  auto doubled = mesh.template add_property_map<Vertex, typename Kernel::Point_3>("v:doubled").first;
  for (const auto vertex : mesh.vertices()) doubled[vertex] = CGAL::ORIGIN + (mesh.point(vertex) - CGAL::ORIGIN) * 2;
  auto k1 = mesh.template add_property_map<Vertex, double>("mine").first;
  uc::curvatures(mesh, rings, umbilic::curvature_options(), doubled, uc::to(umbilic::quantity::k1, k1));
  CHECK(std::abs(k1[Vertex(40)] - 0.25) < 3e-3);
  try {
    uc::curvatures(mesh, rings, umbilic::curvature_options(), uc::to(umbilic::quantity::direction1, k1));
    CHECK(false);
  } catch (const umbilic::error &error) {
    CHECK(error.status() == UMB_ERROR_NOT_APPLICABLE);
  }
}

// Removed elements: results are those after the garbage is collected, and elsewhere what they were.
template <class Kernel>
void removed() {
  auto mesh = sphere<Mesh<Kernel>>(true);
  using Vertex = typename Mesh<Kernel>::Vertex_index;
  uc::vertex_normals(mesh);
  uc::curvatures(mesh);
  uc::segment(mesh, umbilic::region_options());
  for (unsigned v : {100u, 200u, 300u}) CGAL::Euler::remove_center_vertex(mesh.halfedge(Vertex(v)), mesh);
  std::mt19937 random(7);
  for (const auto face : std::vector<typename Mesh<Kernel>::Face_index>(mesh.faces().begin(), mesh.faces().end())) {
    if (random() % 12 == 0) CGAL::Euler::remove_face(mesh.halfedge(face), mesh);
  }
  CHECK(mesh.number_of_removed_vertices() > 0 && mesh.number_of_removed_faces() > 10);
  auto normal = mesh.template property_map<Vertex, typename Kernel::Vector_3>("v:normal").first;
  auto k1 = mesh.template property_map<Vertex, double>("v:k1").first;
  auto label = mesh.template property_map<typename Mesh<Kernel>::Face_index, std::uint32_t>("f:segment").first;
  const auto slots = mesh.number_of_vertices() + mesh.number_of_removed_vertices();
  for (unsigned v = 0; v < slots; v++) {
    if (mesh.is_removed(Vertex(v))) k1[Vertex(v)] = -99, normal[Vertex(v)] = typename Kernel::Vector_3(5, 6, 7);
  }
  const auto rings = uc::build_topology(mesh);
  CHECK(rings.has_gaps() && rings.vertex_count() == slots && rings.face_count() == mesh.number_of_faces());
  uc::vertex_normals(mesh, rings);
  uc::curvatures(mesh, rings, UMB_CURVATURE_JET);
  const auto corners = uc::halfedge_normals(mesh, 0.3);
  const auto segments = uc::segment(mesh, umbilic::feature_options());
  for (unsigned v = 0; v < slots; v++) {
    if (mesh.is_removed(Vertex(v))) CHECK(k1[Vertex(v)] == -99 && plain(normal[Vertex(v)])[2] == 7);
  }
  for (const auto face : mesh.faces()) {
    CHECK(label[face] < segments.count());
    CHECK(std::abs(product(corners[mesh.halfedge(face)], corners[mesh.halfedge(face)]) - 1) < 1e-12);
  }
  // Wherever removed vertices lie, or if they lie nowhere.
  const auto compute = [](Mesh<Kernel> copy) {
    std::vector<double> found;
    const auto curvatures = uc::curvatures(copy);
    const auto by_corner = uc::halfedge_normals(copy);
    uc::segment(copy, umbilic::region_options());
    const auto labels = copy.template property_map<typename Mesh<Kernel>::Face_index, std::uint32_t>("f:segment").first;
    for (const auto vertex : copy.vertices()) found.push_back(curvatures.k1[vertex]), found.push_back(curvatures.k2[vertex]);
    for (const auto face : copy.faces()) {
      found.push_back(labels[face]);
      for (const double part : plain(by_corner[copy.halfedge(face)])) found.push_back(part);
    }
    return found;
  };
  const auto expected = compute(mesh);
  for (const double away : {1e4, -1e7, static_cast<double>(INFINITY)}) {
    // Exact numbers are finite.
    if (!std::is_floating_point_v<typename Kernel::FT> && std::isinf(away)) continue;
    auto copy = mesh;
    for (unsigned v = 0; v < slots; v++) {
      if (copy.is_removed(Vertex(v))) copy.point(Vertex(v)) = typename Kernel::Point_3(away, 0, away);
    }
    CHECK(compute(copy) == expected);
  }
  // A list stays the caller's.
  umbilic::normal_options options;
  const std::vector<std::uint32_t> one = {3};
  options.only(one);
  normal[Vertex(4)] = typename Kernel::Vector_3(5, 6, 7);
  uc::vertex_normals(mesh, rings, options);
  CHECK(plain(normal[Vertex(4)])[1] == 6);
  uc::vertex_normals(mesh, rings);

  const auto before = mesh.template add_property_map<Vertex, typename Kernel::Vector_3>("before").first;
  const auto k1_before = mesh.template add_property_map<Vertex, double>("k1 before").first;
  for (const auto vertex : mesh.vertices()) before[vertex] = normal[vertex], k1_before[vertex] = k1[vertex];
  mesh.collect_garbage();
  uc::vertex_normals(mesh);
  const auto found = uc::curvatures(mesh, UMB_CURVATURE_JET);
  for (const auto vertex : mesh.vertices()) {
    CHECK(product(before[vertex] - normal[vertex], before[vertex] - normal[vertex]) < 1e-24);
    CHECK(std::abs(k1_before[vertex] - found.k1[vertex]) < 1e-9);
  }
}

// A graph without indices or arrays, and maps of the caller's.
template <class Kernel>
void polyhedron() {
  using Polyhedron = CGAL::Polyhedron_3<Kernel>;
  const auto mesh = sphere<Mesh<Epick>>(false);
  Polyhedron graph;
  CGAL::copy_face_graph(mesh, graph);
  using Vertex = typename boost::graph_traits<Polyhedron>::vertex_descriptor;
  using Face = typename boost::graph_traits<Polyhedron>::face_descriptor;
  using Halfedge = typename boost::graph_traits<Polyhedron>::halfedge_descriptor;
  std::map<Vertex, typename Kernel::Vector_3> normals;
  std::map<Vertex, std::array<float, 3>> directions;
  std::map<Vertex, double> k1;
  std::map<Vertex, std::uint8_t> statuses;
  std::map<Face, std::size_t> labels;
  std::map<Halfedge, typename Kernel::Vector_3> corners;
  uc::vertex_normals(graph, boost::make_assoc_property_map(normals));
  CHECK(normals.size() == num_vertices(graph));
  for (const auto &[vertex, normal] : normals) CHECK(std::abs(product(normal, vertex->point()) / 2 - 1) < 1e-3);
  using umbilic::quantity::direction1;
  uc::curvatures(graph, umbilic::curvature_options(), uc::to(umbilic::quantity::k1, boost::make_assoc_property_map(k1)),
                 uc::to(direction1, boost::make_assoc_property_map(directions)),
                 uc::to(umbilic::quantity::status, boost::make_assoc_property_map(statuses)));
  for (const auto &[vertex, curvature] : k1) {
    CHECK(std::abs(curvature - 0.5) < 5e-3 && statuses[vertex] == 0);
    const auto &d = directions[vertex];
    CHECK(std::abs(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - 1) < 1e-6f);
  }
  const auto segments = uc::segment(graph, boost::make_assoc_property_map(labels), umbilic::feature_options());
  CHECK(segments.count() == 1 && labels.size() == num_faces(graph));
  uc::halfedge_normals(graph, boost::make_assoc_property_map(corners));
  CHECK(corners.size() == num_halfedges(graph));
  for (const auto &[halfedge, normal] : corners) CHECK(product(normal, normals[target(halfedge, graph)]) > 1 - 1e-12);

  // A list, by the order of the vertices.
  std::map<Vertex, typename Kernel::Vector_3> few;
  umbilic::normal_options options;
  const std::vector<std::uint32_t> list = {2, 5};
  options.only(list);
  const auto rings = uc::build_topology(graph);
  uc::vertex_normals(graph, rings, boost::make_assoc_property_map(few), options);
  CHECK(few.size() == 2 && few.begin()->second == normals[few.begin()->first]);
}

void corners_of_cube() {
  Mesh<Epick> mesh;
  std::vector<Mesh<Epick>::Vertex_index> v;
  for (int i = 0; i < 8; i++) v.push_back(mesh.add_vertex(Epick::Point_3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  for (const auto &f : {std::array<std::size_t, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}) {
    mesh.add_face(v[f[0]], v[f[1]], v[f[2]], v[f[3]]);
  }
  const auto normals = uc::halfedge_normals(mesh);
  const auto flat = umbilic::face_normals(uc::polygons_of(mesh), {mesh.points().data(), mesh.number_of_vertices()});
  for (const auto face : mesh.faces()) {
    for (const auto halfedge : mesh.halfedges_around_face(mesh.halfedge(face))) CHECK(plain(normals[halfedge]) == flat[face]);
  }
  CHECK(uc::segment(mesh, umbilic::feature_options()).count() == 6);

  // CGAL finds the same edges; those around one face alone part it from the rest.
  auto sharp = mesh.add_property_map<Mesh<Epick>::Edge_index, bool>("e:is_feature", false).first;
  CGAL::Polygon_mesh_processing::detect_sharp_edges(mesh, 60, sharp);
  auto marked = uc::marked_edges(mesh, sharp);
  CHECK(marked.size() == 12);
  umbilic::creases marks;
  marks.mark(marked);
  auto by_marks = mesh.add_property_map<Mesh<Epick>::Halfedge_index, Epick::Vector_3>("h:by_marks").first;
  uc::halfedge_normals(mesh, by_marks, marks);
  for (const auto halfedge : mesh.halfedges()) CHECK(by_marks[halfedge] == normals[halfedge]);
  const auto bottom = *mesh.faces().begin();
  for (const auto edge : mesh.edges()) sharp[edge] = false;
  for (const auto halfedge : mesh.halfedges_around_face(mesh.halfedge(bottom))) sharp[mesh.edge(halfedge)] = true;
  marked = uc::marked_edges(mesh, sharp);
  marks.mark(marked);
  umbilic::feature_options by_these;
  by_these.creases = &marks;
  CHECK(marked.size() == 4 && uc::segment(mesh, by_these).count() == 2);
}

// In a graph whose vertices have no numbers of their own.
void marked_edges_of_polyhedron() {
  CGAL::Polyhedron_3<Epick> graph;
  CGAL::copy_face_graph(sphere<Mesh<Epick>>(true), graph);
  using Edge = boost::graph_traits<CGAL::Polyhedron_3<Epick>>::edge_descriptor;
  std::map<Edge, bool> equator;
  for (const auto edge : edges(graph)) {
    equator[edge] = std::abs(source(edge, graph)->point().z()) < 1e-12 && std::abs(target(edge, graph)->point().z()) < 1e-12;
  }
  const auto marked = uc::marked_edges(graph, boost::make_assoc_property_map(equator));
  CHECK(marked.size() == 32);
  umbilic::creases marks;
  marks.mark(marked);
  umbilic::feature_options options;
  options.creases = &marks;
  std::map<boost::graph_traits<CGAL::Polyhedron_3<Epick>>::face_descriptor, std::size_t> labels;
  CHECK(uc::segment(graph, boost::make_assoc_property_map(labels), options).count() == 2);
  double heights[2] = {0, 0};
  std::size_t faces[2] = {0, 0};
  for (const auto &[face, label] : labels) {
    const auto side = face->halfedge();
    const double height = side->vertex()->point().z() + side->next()->vertex()->point().z() + side->prev()->vertex()->point().z();
    CHECK(height * heights[label] >= 0);
    heights[label] += height;
    faces[label]++;
  }
  CHECK(faces[0] == faces[1] && heights[0] * heights[1] < 0);
}

void errors() {
  auto mesh = sphere<Mesh<Epick>>(true);
  mesh.point(Mesh<Epick>::Vertex_index(17)) = Epick::Point_3(INFINITY, 0, 0);
  try {
    uc::vertex_normals(mesh);
    CHECK(false);
  } catch (const umbilic::error &error) {
    CHECK(error.status() == UMB_ERROR_NON_FINITE && error.element() == 17);
  }
  Mesh<Simple> empty;
  uc::vertex_normals(empty);
  uc::curvatures(empty);
  uc::halfedge_normals(empty);
  CHECK(uc::segment(empty, umbilic::feature_options()).count() == 0);
}

}  // namespace

int main() {
  whole<Simple>(true);
  whole<Simple>(false);
  whole<Epick>(true);
  whole<Epick>(false);
  whole<Single>(true);
  whole<Epeck>(true);
  removed<Simple>();
  removed<Epick>();
  removed<Epeck>();
  polyhedron<Epick>();
  polyhedron<Epeck>();
  corners_of_cube();
  marked_edges_of_polyhedron();
  errors();
  std::puts("cgal: four kernels and a graph without indices");
  return 0;
}
