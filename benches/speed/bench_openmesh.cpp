// Times OpenMesh, in single precision, and umbilic: see program.h for the arguments; the set of tasks is "all", and what
// can be run once is "structure" and "normals". OpenMesh runs on one thread.
#include "tasks.h"

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

template <class Mesh> void build(const mesh &m, Mesh &out) {
  out.reserve(m.vertex_count, m.corner_count / 2, m.polygon_count);
  for (std::size_t vertex = 0; vertex < m.vertex_count; vertex++) {
    const float *at = m.positions + 3 * vertex;
    out.add_vertex(typename Mesh::Point(at[0], at[1], at[2]));
  }
  std::vector<OpenMesh::VertexHandle> corners;
  for (std::size_t polygon = 0; polygon < m.polygon_count; polygon++) {
    const std::size_t begin = m.offsets ? m.offsets[polygon] : 3 * polygon;
    const std::size_t end = m.offsets ? m.offsets[polygon + 1] : 3 * polygon + 3;
    corners.clear();
    for (std::size_t corner = begin; corner < end; corner++) {
      corners.emplace_back(static_cast<int>(m.corners[corner]));
    }
    if (!out.add_face(corners).is_valid()) {
      std::fputs("OpenMesh refuses a face\n", stderr);
      std::exit(1);
    }
  }
  out.request_face_normals();
  out.request_vertex_normals();
}

// With the normals of faces, which the first of these needs.
template <class Mesh, class Method> void normals(Mesh &in, Method method) {
  in.update_face_normals();
  for (const OpenMesh::VertexHandle vertex : in.vertices()) {
    typename Mesh::Normal normal;
    (in.*method)(vertex, normal);
    in.set_normal(vertex, normal.normalize_cond());
  }
}

template <class Mesh> int serve(const program &p) {
  Mesh built;
  const bool peak = p.peak != nullptr;
  if (!peak || std::strcmp(p.peak, "nothing") != 0) {
    build(p.m, built);
  }
  if (peak) {
    if (!std::strcmp(p.peak, "normals")) {
      normals(built, &Mesh::calc_vertex_normal_fast);
    }
    print_peak(&p, 0);
    return 0;
  }
  Tasks tasks(p);
  tasks.add_ours("topology", UMB_SCALAR_F32);
  tasks.add_ours("uniform", UMB_SCALAR_F32);
  tasks.add_ours("area", UMB_SCALAR_F32);
  tasks.add_ours("N_CM", UMB_SCALAR_F32);
  tasks.add("OpenMesh", "structure", "f32", [&p] {
    Mesh again;
    build(p.m, again);
  });
  tasks.add("OpenMesh", "calc_vertex_normal_fast", "f32", [&] { normals(built, &Mesh::calc_vertex_normal_fast); });
  tasks.add("OpenMesh", "calc_vertex_normal_correct", "f32",
            [&] { normals(built, &Mesh::calc_vertex_normal_correct); });
  tasks.add("OpenMesh", "calc_vertex_normal_loop", "f32", [&] { normals(built, &Mesh::calc_vertex_normal_loop); });
  tasks.time();
  return 0;
}

} // namespace

int main(int argc, char **argv) {
  if (argc == 2 && !std::strcmp(argv[1], "--version")) {
    std::printf("OpenMesh %d.%d\n", OM_GET_VER, OM_GET_MAJ);
    return 0;
  }
  program p = start_program("openmesh", argc, argv);
  const int result = p.m.offsets ? serve<OpenMesh::PolyMesh_ArrayKernelT<>>(p)
                                 : serve<OpenMesh::TriMesh_ArrayKernelT<>>(p);
  free_mesh(&p.m);
  return result;
}
