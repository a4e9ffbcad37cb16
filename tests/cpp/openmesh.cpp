// umbilic/openmesh.hpp on meshes of triangles and polygons, in three kinds of scalars, whole and with deleted elements.
#if defined(__GNUC__) && !defined(__clang__)
// OpenMesh fills its arrays with vectors that it leaves uninitialised, which gcc reports after inlining.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "umbilic/openmesh.hpp"
#include "umbilic/openmesh_decimater.hpp"

#include <cmath>
#include <random>
#include <string>

#include "allocations.hpp"
#include "check.hpp"

namespace {

namespace um = umbilic::openmesh;

constexpr double PI = 3.14159265358979323846;

// Coordinates that no view reads: they are converted.
struct LongTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::VectorT<long double, 3>;
  using Normal = OpenMesh::VectorT<long double, 3>;
};
// Positions in double, normals in float.
struct MixedTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3f;
};
using TriFloat = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraits>;
using TriDouble = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using TriMixed = OpenMesh::TriMesh_ArrayKernelT<MixedTraits>;
using TriLong = OpenMesh::TriMesh_ArrayKernelT<LongTraits>;
using PolyFloat = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraits>;
using PolyDouble = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

// A sphere of radius 2, of quads but for its poles.
template <class Mesh>
Mesh sphere(int around = 32, int across = 16) {
  Mesh mesh;
  std::vector<OpenMesh::VertexHandle> ring;
  const auto place = [&](double x, double y, double z) {
    using Scalar = typename Mesh::Scalar;
    ring.push_back(mesh.add_vertex(typename Mesh::Point(static_cast<Scalar>(x), static_cast<Scalar>(y), static_cast<Scalar>(z))));
  };
  for (int i = 1; i < across; i++) {
    for (int j = 0; j < around; j++) {
      const double down = PI * i / across, turn = 2 * PI * j / around;
      place(2 * std::sin(down) * std::cos(turn), 2 * std::sin(down) * std::sin(turn), 2 * std::cos(down));
    }
  }
  place(0, 0, 2);
  place(0, 0, -2);
  const auto at = [&](int i, int j) { return ring[static_cast<std::size_t>(i * around + j % around)]; };
  for (int j = 0; j < around; j++) {
    mesh.add_face({ring[ring.size() - 2], at(0, j), at(0, j + 1)});
    for (int i = 0; i + 2 < across; i++) {
      // On triangle meshes OpenMesh cuts it in two.
      mesh.add_face({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.add_face({at(across - 2, j + 1), at(across - 2, j), ring[ring.size() - 1]});
  }
  return mesh;
}

template <class Mesh>
Mesh cube() {
  Mesh mesh;
  OpenMesh::VertexHandle v[8];
  for (unsigned i = 0; i < 8; i++) {
    const auto side = [&](unsigned bit) { return static_cast<typename Mesh::Scalar>(i & bit ? 1 : -1); };
    v[i] = mesh.add_vertex({side(1), side(2), side(4)});
  }
  for (const auto &f : {std::array<std::size_t, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}) {
    mesh.add_face({v[f[0]], v[f[1]], v[f[2]], v[f[3]]});
  }
  return mesh;
}

template <class A, class B>
double product(const A &a, const B &b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; k++) sum += static_cast<double>(a[k]) * static_cast<double>(b[k]);
  return sum;
}

template <class Mesh>
void whole(bool exact) {
  auto mesh = sphere<Mesh>();
  CHECK(!mesh.has_vertex_normals());
  std::vector<std::uint8_t> statuses(mesh.n_vertices(), 99);
  um::vertex_normals(mesh, UMB_WEIGHT_MAX, statuses);
  const auto rings = um::build_topology(mesh);
  CHECK(rings.vertex_count() == mesh.n_vertices() && rings.face_count() == mesh.n_faces() && !rings.has_gaps());
  CHECK(rings.stats().euler_characteristic == 2 && rings.stats().edge_count == mesh.n_edges());
  const auto properties = um::curvatures(mesh, rings);
  for (const auto vertex : mesh.vertices()) {
    CHECK(statuses[static_cast<std::size_t>(vertex.idx())] == 0);
    const auto normal = mesh.normal(vertex);
    // Max's normal is exact where neighbours lie on a sphere and faces are triangles.
    const double along = product(normal, mesh.point(vertex)) / 2;
    CHECK(std::abs(along - 1) < (mesh.is_trimesh() ? 1e-6 : 1e-3));
    CHECK(std::abs(static_cast<double>(mesh.property(properties.k1, vertex)) - 0.5) < 5e-3);
    CHECK(std::abs(static_cast<double>(mesh.property(properties.mean, vertex)) - 0.5) < 5e-3);
    CHECK(std::abs(static_cast<double>(mesh.property(properties.gauss, vertex)) - 0.25) < 5e-3);
    CHECK(std::abs(product(mesh.property(properties.dir1, vertex), mesh.property(properties.dir2, vertex))) < 1e-6);
  }
  // Properties are found again, not added twice; those of a method are what it has.
  const auto again = um::curvatures(mesh, UMB_CURVATURE_ANGLE_DEFECT);
  CHECK(again.gauss.idx() == properties.gauss.idx() && !again.k1.is_valid() && !again.dir1.is_valid());
  um::curvatures(mesh, rings, {}, umbilic::quantity::curvedness | umbilic::quantity::status | umbilic::quantity::normal);
  OpenMesh::VPropHandleT<um::detail::scalar<Mesh>> curvedness;
  OpenMesh::VPropHandleT<std::uint8_t> status;
  CHECK(mesh.get_property_handle(curvedness, "v:curvedness") && mesh.get_property_handle(status, "v:curvature_status"));
  CHECK(std::abs(static_cast<double>(mesh.property(curvedness, OpenMesh::VertexHandle(40))) - 0.5) < 5e-3);

  // With a topology that stands, nothing is copied (names of properties are strings).
  const std::size_t before = allocated_bytes;
  um::vertex_normals(mesh, rings, UMB_WEIGHT_MAX);
  um::curvatures(mesh, rings);
  CHECK((allocated_bytes - before < mesh.n_vertices()) == (um::detail::IN_PLACE<typename Mesh::Point>));

  // In the mesh's own memory: to the bit what the library writes elsewhere.
  if constexpr (um::detail::IN_PLACE<typename Mesh::Point> && std::is_same_v<typename Mesh::Point, typename Mesh::Normal>) {
    const auto here = umbilic::vertex_normals<typename Mesh::Scalar>(rings, {mesh.points(), mesh.n_vertices()}, UMB_WEIGHT_MAX);
    for (std::size_t v = 0; v < here.size(); v++) {
      const auto normal = mesh.normal(OpenMesh::VertexHandle(static_cast<int>(v)));
      CHECK(normal[0] == here[v][0] && normal[1] == here[v][1] && normal[2] == here[v][2]);
    }
    CHECK(exact);
  } else {
    CHECK(!exact);
  }

  // A height in a property, and basins of it.
  OpenMesh::VPropHandleT<double> height;
  mesh.add_property(height, "height");
  for (const auto vertex : mesh.vertices()) mesh.property(height, vertex) = -std::abs(static_cast<double>(mesh.point(vertex)[2]));
  umbilic::watershed_options basins;
  const umbilic::scalars heights = um::numbers_in(mesh, height);
  basins.height = &heights;
  basins.depth = 1;
  const auto segments = um::segment(mesh, basins);
  CHECK(segments.count() == 2);
  OpenMesh::FPropHandleT<std::uint32_t> segment;
  CHECK(mesh.get_property_handle(segment, "f:segment"));
  for (const auto face : mesh.faces()) CHECK(mesh.property(segment, face) < 2);
  const auto areas = segments.areas(um::polygons_of(mesh), um::detail::positions<Mesh>(mesh));
  CHECK(std::abs(areas[0] + areas[1] - 16 * PI) < 0.02 * 16 * PI);
}

// Faces are deleted, then vertices: results are those of the mesh after its garbage is collected, and elsewhere what they were.
template <class Mesh>
void deleted() {
  auto mesh = sphere<Mesh>();
  um::curvatures(mesh);
  um::vertex_normals(mesh);
  um::segment(mesh, umbilic::region_options());
  mesh.request_vertex_status(), mesh.request_edge_status(), mesh.request_face_status(), mesh.request_halfedge_status();
  std::mt19937 random(7);
  std::vector<OpenMesh::FaceHandle> gone;
  for (const auto face : mesh.faces()) {
    if (random() % 12 == 0) gone.push_back(face);
  }
  for (const auto face : gone) mesh.delete_face(face, false);
  mesh.delete_vertex(OpenMesh::VertexHandle(100), false);
  mesh.delete_vertex(OpenMesh::VertexHandle(7), true);

  OpenMesh::VPropHandleT<um::detail::scalar<Mesh>> k1;
  OpenMesh::FPropHandleT<std::uint32_t> segment;
  CHECK(mesh.get_property_handle(k1, "v:k1") && mesh.get_property_handle(segment, "f:segment"));
  typename Mesh::Normal mark(5, 6, 7);
  std::size_t deleted_vertices = 0, deleted_faces = 0;
  for (const auto vertex : mesh.all_vertices()) {
    if (!mesh.status(vertex).deleted()) continue;
    deleted_vertices++;
    mesh.property(k1, vertex) = -99;
    mesh.set_normal(vertex, mark);
  }
  for (const auto face : mesh.all_faces()) {
    if (!mesh.status(face).deleted()) continue;
    deleted_faces++;
    mesh.property(segment, face) = 99;
  }
  CHECK(deleted_vertices >= 2 && deleted_faces > 10);

  const auto rings = um::build_topology(mesh);
  CHECK(rings.has_gaps() && rings.vertex_count() == mesh.n_vertices() && rings.face_count() == mesh.n_faces() - deleted_faces);
  um::vertex_normals(mesh, rings);
  um::curvatures(mesh, rings, UMB_CURVATURE_JET);
  const auto segments = um::segment(mesh, umbilic::feature_options());
  um::halfedge_normals(mesh);
  for (const auto vertex : mesh.all_vertices()) {
    if (mesh.status(vertex).deleted()) CHECK(mesh.property(k1, vertex) == -99 && mesh.normal(vertex) == mark);
  }
  for (const auto face : mesh.all_faces()) {
    const std::uint32_t label = mesh.property(segment, face);
    CHECK(mesh.status(face).deleted() ? label == 99 : label < segments.count());
  }
  // Wherever deleted vertices lie, or if they lie nowhere.
  const auto compute = [](Mesh copy) {
    std::vector<std::array<double, 3>> found;
    const auto properties = um::curvatures(copy);
    um::halfedge_normals(copy);
    for (const auto vertex : copy.vertices()) found.push_back({copy.property(properties.k1, vertex), copy.property(properties.k2, vertex), 0});
    for (const auto halfedge : copy.halfedges()) {
      // Of a halfedge without a face OpenMesh does not initialise the normal.
      if (copy.is_boundary(halfedge)) continue;
      const auto &normal = copy.normal(halfedge);
      found.push_back({static_cast<double>(normal[0]), static_cast<double>(normal[1]), static_cast<double>(normal[2])});
    }
    OpenMesh::FPropHandleT<std::uint32_t> label;
    um::segment(copy, umbilic::region_options());
    CHECK(copy.get_property_handle(label, "f:segment"));
    for (const auto face : copy.faces()) found.push_back({static_cast<double>(copy.property(label, face)), 0, 0});
    return found;
  };
  const auto expected = compute(mesh);
  for (const double away : {1e4, static_cast<double>(NAN), -static_cast<double>(INFINITY)}) {
    auto copy = mesh;
    for (const auto vertex : copy.all_vertices()) {
      if (copy.status(vertex).deleted()) copy.set_point(vertex, typename Mesh::Point(static_cast<um::detail::scalar<Mesh>>(away)));
    }
    CHECK(compute(copy) == expected);
  }
  // It is not the deleted vertices that are to blame for one that is there.
  auto damaged = mesh;
  damaged.delete_vertex(OpenMesh::VertexHandle(0), false);
  for (const int v : {0, 1}) {
    damaged.set_point(OpenMesh::VertexHandle(v), typename Mesh::Point(static_cast<um::detail::scalar<Mesh>>(NAN)));
  }
  try {
    um::halfedge_normals(damaged);
    CHECK(false);
  } catch (const umbilic::error &failure) {
    CHECK(failure.status() == UMB_ERROR_NON_FINITE && failure.element() == 1);
  }
  // Rings of before, on a mesh that has lost its garbage and the marks of it.
  auto collected = mesh;
  collected.garbage_collection();
  collected.release_vertex_status(), collected.release_edge_status(), collected.release_face_status(), collected.release_halfedge_status();
  try {
    um::vertex_normals(collected, rings);
    CHECK(false);
  } catch (const umbilic::error &failure) {
    CHECK(failure.status() == UMB_ERROR_SIZE);
  }

  // A list of the caller's stays his.
  umbilic::normal_options options;
  const std::vector<std::uint32_t> one = {3};
  options.only(one);
  mesh.set_normal(OpenMesh::VertexHandle(4), mark);
  um::vertex_normals(mesh, rings, options);
  CHECK(mesh.normal(OpenMesh::VertexHandle(4)) == mark);
  um::vertex_normals(mesh, rings);

  // Vertices get other numbers: a property keeps what they had, positions tell which is which.
  auto packed = mesh;
  OpenMesh::VPropHandleT<typename Mesh::Normal> before;
  OpenMesh::VPropHandleT<um::detail::scalar<Mesh>> k1_before;
  packed.add_property(before);
  packed.add_property(k1_before);
  for (const auto vertex : packed.vertices()) {
    packed.property(before, vertex) = packed.normal(vertex);
    packed.property(k1_before, vertex) = packed.property(k1, vertex);
  }
  packed.garbage_collection();
  CHECK(packed.n_faces() == mesh.n_faces() - deleted_faces);
  um::vertex_normals(packed);
  const auto properties = um::curvatures(packed, UMB_CURVATURE_JET);
  for (const auto vertex : packed.vertices()) {
    // Sums start at another face.
    CHECK((packed.property(before, vertex) - packed.normal(vertex)).norm() < 1e-5);
    CHECK(std::abs(packed.property(k1_before, vertex) - packed.property(properties.k1, vertex)) < 2e-3);
  }
}

template <class Mesh>
void corners() {
  auto mesh = cube<Mesh>();
  um::halfedge_normals(mesh);
  mesh.request_face_normals();
  mesh.update_face_normals();
  for (const auto halfedge : mesh.halfedges()) {
    CHECK((mesh.normal(halfedge) - mesh.normal(mesh.face_handle(halfedge))).norm() < 1e-6);
  }
  // Where nothing is a crease, they are the vertex normals.
  um::vertex_normals(mesh, UMB_WEIGHT_ANGLE);
  um::halfedge_normals(mesh, 3.2, UMB_WEIGHT_ANGLE);
  for (const auto halfedge : mesh.halfedges()) CHECK(mesh.normal(halfedge) == mesh.normal(mesh.to_vertex_handle(halfedge)));
  // Edges that are features around the top, or groups.
  mesh.request_edge_status();
  for (const auto edge : mesh.edges()) {
    const auto top = [&](auto vertex) { return mesh.point(vertex)[2] > 0; };
    const auto halfedge = mesh.halfedge_handle(edge, 0);
    const bool around = top(mesh.from_vertex_handle(halfedge)) && top(mesh.to_vertex_handle(halfedge)) &&
                        (mesh.normal(mesh.face_handle(halfedge)) - mesh.normal(mesh.opposite_face_handle(halfedge))).norm() > 1;
    mesh.status(edge).set_feature(around);
  }
  const auto check_top = [&] {
    for (const auto halfedge : mesh.halfedges()) {
      const auto face = mesh.normal(mesh.face_handle(halfedge));
      CHECK((mesh.normal(halfedge) == mesh.normal(mesh.to_vertex_handle(halfedge))) == (mesh.point(mesh.to_vertex_handle(halfedge))[2] < 0));
      if (face[2] > 0.5) CHECK((mesh.normal(halfedge) - face).norm() < 1e-6);
    }
  };
  um::halfedge_normals(mesh, 3.2, UMB_WEIGHT_ANGLE);
  check_top();
  um::halfedge_normals(mesh, 3.2, UMB_WEIGHT_ANGLE, false);
  for (const auto halfedge : mesh.halfedges()) CHECK(mesh.normal(halfedge) == mesh.normal(mesh.to_vertex_handle(halfedge)));
  // Half an edge is refused, beside features as well.
  umbilic::creases odd(3.2);
  const std::vector<std::uint32_t> half = {0, 1, 2};
  odd.mark(half);
  try {
    um::halfedge_normals(mesh, odd, UMB_WEIGHT_ANGLE);
    CHECK(false);
  } catch (const umbilic::error &error) {
    CHECK(error.status() == UMB_ERROR_SIZE);
  }
  std::vector<std::uint32_t> groups;
  for (const auto face : mesh.faces()) groups.push_back(mesh.normal(face)[2] > 0.5 ? 2 : 1);
  umbilic::creases grouped(3.2);
  grouped.group(groups);
  um::halfedge_normals(mesh, grouped, UMB_WEIGHT_ANGLE, false);
  check_top();
  CHECK(um::segment(mesh, umbilic::feature_options()).count() == 6);
}

template <class Mesh>
std::size_t decimated(double power, double turn, std::size_t faces) {
  auto mesh = sphere<Mesh>(64, 32);
  OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
  typename um::ModCurvatureT<Mesh>::Handle curvature;
  typename OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric;
  CHECK(decimater.add(curvature));
  auto &module = decimater.module(curvature);
  CHECK(module.name() == "Curvature" && !module.is_binary() && module.power() == 0.5 && module.normal_weight() > 0);
  module.set_power(power);
  module.set_normal_weight(0.1 * power);
  if (turn > 0) {
    CHECK(decimater.add(quadric));
    module.set_largest_turn(turn);
    // Back and forth: the bound comes back from 0. Other bounds do not count.
    module.set_error_tolerance_factor(0.0);
    module.set_error_tolerance_factor(1.0);
    module.set_max_err(1e30);
  } else if (turn < 0) {
    // Binary by the bound of quadrics alone, as ModQuadricT is.
    CHECK(decimater.add(quadric));
    module.set_max_err(1e30);
  }
  CHECK(decimater.initialize());
  decimater.decimate_to_faces(0, faces);
  mesh.garbage_collection();
  um::vertex_normals(mesh);
  return mesh.n_faces();
}

void errors() {
  auto mesh = sphere<TriDouble>();
  mesh.set_point(OpenMesh::VertexHandle(17), {INFINITY, 0, 0});
  try {
    um::vertex_normals(mesh);
    CHECK(false);
  } catch (const umbilic::error &error) {
    CHECK(error.status() == UMB_ERROR_NON_FINITE && error.element() == 17);
  }
  TriFloat empty;
  um::vertex_normals(empty);
  um::curvatures(empty);
  um::halfedge_normals(empty);
  CHECK(um::segment(empty, umbilic::feature_options()).count() == 0);
}

}  // namespace

int main() {
  whole<TriFloat>(true);
  whole<TriDouble>(true);
  whole<TriMixed>(false);
  whole<TriLong>(false);
  whole<PolyFloat>(true);
  whole<PolyDouble>(true);
  deleted<TriFloat>();
  deleted<TriDouble>();
  deleted<PolyDouble>();
  corners<TriDouble>();
  corners<PolyFloat>();
  const std::size_t all = sphere<TriFloat>(64, 32).n_faces();
  CHECK(decimated<TriFloat>(1, 0, 500) <= 500 && decimated<TriDouble>(0, 0, 500) <= 500);
  // Along no edge does a sphere turn so little; a fair turn keeps more than a large one.
  CHECK(decimated<TriDouble>(1, 1e-4, 10) == all);
  CHECK(decimated<TriDouble>(0, -1, 500) <= 500);
  CHECK(decimated<TriDouble>(1, 0.2, 10) > 2 * decimated<TriDouble>(1, 0.5, 10));
  errors();
  std::puts("openmesh: in the mesh's own memory, with and without gaps");
  return 0;
}
