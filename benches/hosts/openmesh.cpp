/* umbilic in OpenMesh's meshes of float: what the user writes, and what the adapter costs. Prints what host.hpp says. */

#if defined(__GNUC__) && !defined(__clang__)
// OpenMesh fills its arrays with vectors that it leaves uninitialised, which gcc reports after inlining.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <exception>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <umbilic/openmesh.hpp>

#include "host.hpp"

namespace {

using Mesh = OpenMesh::PolyMesh_ArrayKernelT<>;

void compute(Mesh &mesh) {
  // begin: user code
  umbilic::openmesh::vertex_normals(mesh);
  umbilic::openmesh::curvatures(mesh);
  // end: user code
}

void run(Mesh &mesh) {
  compute(mesh);
  const umbilic::polygons loops = umbilic::openmesh::polygons_of(mesh);
  umbilic::topology_options one;
  one.threads = 1;
  host::report(
      "OpenMesh", "topology", "1", [&] { umbilic::topology(loops, mesh.n_vertices(), one); },
      [&] { umbilic::openmesh::build_topology(mesh, one); });

  const umbilic::host_topology rings = umbilic::openmesh::build_topology(mesh);
  umbilic::normal_options normals;
  normals.run.threads = 1;
  auto &room = mesh.property(mesh.vertex_normals_pph()).data_vector();
  const umbilic::points positions(mesh.points(), mesh.n_vertices());
  host::report(
      "OpenMesh", "vertex normals", "0", [&] { umbilic::vertex_normals(rings, positions, room, normals); },
      [&] { umbilic::openmesh::vertex_normals(mesh, rings, normals); });

  umbilic::curvature_options curvatures;
  curvatures.run.threads = 1;
  const auto wanted =
      umbilic::quantity::k1 | umbilic::quantity::k2 | umbilic::quantity::direction1 | umbilic::quantity::direction2;
  const auto found = umbilic::openmesh::curvatures(mesh, rings, curvatures, wanted);
  umbilic::curvature_outputs into;
  into.k1 = mesh.property(found.k1).data_vector();
  into.k2 = mesh.property(found.k2).data_vector();
  into.direction1 = mesh.property(found.dir1).data_vector();
  into.direction2 = mesh.property(found.dir2).data_vector();
  host::report(
      "OpenMesh", "curvature", "0", [&] { umbilic::curvatures(rings, positions, into, curvatures); },
      [&] { umbilic::openmesh::curvatures(mesh, rings, curvatures, wanted); });
}

}  // namespace

int main(int count, char **arguments) try {
  Mesh mesh;
  if (count != 2 || !OpenMesh::IO::read_mesh(mesh, arguments[1])) {
    std::fprintf(stderr, "usage: %s MESH\n", arguments[0]);
    return 2;
  }
  run(mesh);
} catch (const std::exception &failure) {
  std::fprintf(stderr, "%s\n", failure.what());
  return 1;
}
