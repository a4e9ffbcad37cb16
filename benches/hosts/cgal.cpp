/*
 * umbilic in CGAL's Surface_mesh: what the user writes, and what the adapter costs, where points are doubles in a row and where they are
 * exact numbers. Prints what host.hpp says.
 */
#include <exception>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <umbilic/cgal.hpp>

#include "host.hpp"

namespace {

template <class Mesh>
void compute(Mesh &mesh) {
  // begin: user code
  auto normals = umbilic::cgal::vertex_normals(mesh);
  auto found = umbilic::cgal::curvatures(mesh);
  // end: user code
  (void)normals;
  (void)found;
}

template <class Kernel>
bool run(const char *path, const char *name, const char *copies) {
  using Mesh = CGAL::Surface_mesh<typename Kernel::Point_3>;
  Mesh mesh;
  if (!CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(path, mesh)) return false;
  compute(mesh);
  const umbilic::polygons loops = umbilic::cgal::polygons_of(mesh);
  umbilic::topology_options one;
  one.threads = 1;
  host::report(
      name, "topology", "1", [&] { umbilic::topology(loops, mesh.num_vertices(), one); },
      [&] { umbilic::cgal::build_topology(mesh, one); });

  const umbilic::host_topology rings = umbilic::cgal::build_topology(mesh);
  std::vector<std::array<double, 3>> positions;
  for (const auto vertex : mesh.vertices()) {
    const auto &point = mesh.point(vertex);
    positions.push_back({CGAL::to_double(point.x()), CGAL::to_double(point.y()), CGAL::to_double(point.z())});
  }
  umbilic::normal_options normals;
  normals.run.threads = 1;
  std::vector<std::array<double, 3>> room(positions.size());
  host::report(
      name, "vertex normals", copies, [&] { umbilic::vertex_normals(rings, positions, room, normals); },
      [&] { umbilic::cgal::vertex_normals(mesh, rings, normals); });

  umbilic::curvature_options curvatures;
  curvatures.run.threads = 1;
  const auto wanted =
      umbilic::quantity::k1 | umbilic::quantity::k2 | umbilic::quantity::direction1 | umbilic::quantity::direction2;
  std::vector<double> k1(positions.size()), k2(positions.size());
  std::vector<std::array<double, 3>> dir1(positions.size()), dir2(positions.size());
  umbilic::curvature_outputs into;
  into.k1 = k1;
  into.k2 = k2;
  into.direction1 = dir1;
  into.direction2 = dir2;
  host::report(
      name, "curvature", copies, [&] { umbilic::curvatures(rings, positions, into, curvatures); },
      [&] { umbilic::cgal::curvatures(mesh, rings, curvatures, wanted); });
  return true;
}

}  // namespace

int main(int count, char **arguments) try {
  if (count != 2 || !run<CGAL::Exact_predicates_inexact_constructions_kernel>(arguments[1], "CGAL, EPICK", "0") ||
      !run<CGAL::Exact_predicates_exact_constructions_kernel>(arguments[1], "CGAL, EPECK", "1 in, 1 out")) {
    std::fprintf(stderr, "usage: %s MESH\n", arguments[0]);
    return 2;
  }
} catch (const std::exception &failure) {
  std::fprintf(stderr, "%s\n", failure.what());
  return 1;
}
