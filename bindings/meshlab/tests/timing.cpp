// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the filters cost beside the library: for a mesh, lines of host, quantity, copies, milliseconds of the library's calls alone, and of the
// filter beyond these. The filter is run as MeshLab runs it, with a new topology each time; the library's calls are timed on the mesh's own arrays.
// All on one thread, best of alternating runs.
//
//   QT_QPA_PLATFORM=offscreen timing PLUGIN MESH.off
#include "meshes.h"
#include "plugin.h"
#include "vcg_mesh.h"

#include <QApplication>

#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>

namespace {

constexpr int RUNS = 25;
constexpr std::chrono::seconds LONGEST{30};

/** Keeps the least milliseconds that something takes. */
struct Best {
  double ms = std::numeric_limits<double>::infinity();

  template <class Work>
  void time(Work work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    ms = std::min(ms, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
};

void print(const char *quantity, int copies, double library, double adapter) {
  std::printf("meshlab\t%s\t%d\t%.3f\t%.3f\n", quantity, copies, library, adapter);
}

}  // namespace

int main(int argc, char **argv) {
  QApplication application(argc, argv);
  // The library takes as many threads as there are cores to run on.
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(sched_getcpu(), &one);
  sched_setaffinity(0, sizeof one, &one);

  Plugin plugin(argv[1]);
  MeshDocument document;
  CMeshO &mesh = document.addNewMesh("", "layer")->cm;
  fill(mesh, read_off(argv[2]), Order::polygon_by_polygon, 0);
  if (mesh.face.empty()) qFatal("%s cannot be read", argv[2]);
  vcg::tri::UpdateBounding<CMeshO>::Box(mesh);
  RichParameterList normals = plugin.parameters(NORMALS, document), curvature = plugin.parameters(CURVATURE, document);
  curvature.setValue("quality", EnumValue(6));
  if (!plugin.apply(CURVATURE, document, curvature)) qFatal("%s", plugin.message().c_str());

  umbilic::topology_options of_topology;
  of_topology.threads = 1;
  umbilic::normal_options of_normals;
  of_normals.run.threads = 1;
  umbilic::curvature_options of_curvatures;
  of_curvatures.run.threads = 1;
  const umbilic_meshlab::mesh_faces faces = umbilic_meshlab::faces_of(mesh);
  const umbilic::topology rings(faces.polygons, mesh.vert.size(), of_topology);
  umbilic::curvature_outputs into;
  const umbilic_meshlab::principal_curvatures principal(mesh);
  into.k1 = principal.k1;
  into.k2 = principal.k2;
  into.direction1 = principal.direction1;
  into.direction2 = principal.direction2;

  const umbilic::points positions = umbilic_meshlab::positions_of(mesh);
  const umbilic::vectors into_normals = umbilic_meshlab::normals_of(mesh);
  // What the filters spend in the library: the topology and the quantity.
  const auto normals_from_faces = [&] { umbilic::vertex_normals(umbilic::faces(faces.polygons), positions, into_normals, of_normals); };
  const auto curvatures_from_faces = [&] {
    umbilic::curvatures(umbilic::topology(faces.polygons, mesh.vert.size(), of_topology), positions, into, of_curvatures);
  };
  Best build_faces, topology, library_normals, library_curvatures, all_normals, all_curvatures, filter_normals, filter_curvatures;
  const auto start = std::chrono::steady_clock::now();
  for (int run = 0; run < RUNS && std::chrono::steady_clock::now() - start < LONGEST; run++) {
    build_faces.time([&] { umbilic_meshlab::faces_of(mesh); });
    topology.time([&] { umbilic::topology(faces.polygons, mesh.vert.size(), of_topology); });
    library_normals.time([&] { umbilic::vertex_normals(rings, positions, into_normals, of_normals); });
    library_curvatures.time([&] { umbilic::curvatures(rings, positions, into, of_curvatures); });
    all_normals.time(normals_from_faces);
    filter_normals.time([&] { plugin.apply(NORMALS, document, normals); });
    all_curvatures.time(curvatures_from_faces);
    filter_curvatures.time([&] { plugin.apply(CURVATURE, document, curvature); });
  }
  print("topology", 1, topology.ms, build_faces.ms);
  print("vertex normals", 0, library_normals.ms, filter_normals.ms - all_normals.ms - build_faces.ms);
  print("curvature", 0, library_curvatures.ms, filter_curvatures.ms - all_curvatures.ms - build_faces.ms);
  return 0;
}
