// SPDX-License-Identifier: GPL-3.0-or-later
//
// MeshLab's mesh as views that umbilic takes: positions, normals, qualities and curvature directions where they lie in the mesh's own arrays,
// and faces, which MeshLab keeps as triangles of pointers, as polygons of indices.
//
// A mesh has to be without gaps (`compact`), and to stay as it is while its views are used.
#ifndef UMBILIC_MESHLAB_VCG_MESH_H
#define UMBILIC_MESHLAB_VCG_MESH_H

#include <common/ml_mesh_type.h>

#include <umbilic.hpp>

namespace umbilic_meshlab {

/** The faces of a mesh, and which of them each triangle is a part of. */
struct mesh_faces {
  umbilic::polygons polygons;
  std::vector<std::uint32_t> face_of;  // by triangle; none if each is a face of its own

  std::size_t face(std::size_t triangle) const { return face_of.empty() ? triangle : face_of[triangle]; }
};

/** Moves elements into the gaps that deleted ones have left, as MeshLab itself does after every filter. */
void compact(CMeshO &mesh);

/**
 * Polygons, each in the order and orientation of its first triangle. Triangles are joined across edges that both of them mark as faux and run
 * through in opposite directions, those that come first if there are several; where that would swallow a vertex or leave a hole, they stay triangles.
 */
mesh_faces faces_of(const CMeshO &mesh);

inline umbilic::points positions_of(const CMeshO &mesh) {
  return mesh.vert.empty() ? umbilic::points() : umbilic::points(mesh.vert[0].P().V(), mesh.vert.size(), sizeof(CVertexO));
}

/** Normals as given ones, to read. */
inline umbilic::points given_normals_of(const CMeshO &mesh) {
  return mesh.vert.empty() ? umbilic::points() : umbilic::points(mesh.vert[0].N().V(), mesh.vert.size(), sizeof(CVertexO));
}

inline umbilic::vectors normals_of(CMeshO &mesh) {
  return mesh.vert.empty() ? umbilic::vectors() : umbilic::vectors(mesh.vert[0].N().V(), mesh.vert.size(), sizeof(CVertexO));
}

inline umbilic::numbers qualities_of(CMeshO &mesh) {
  return mesh.vert.empty() ? umbilic::numbers() : umbilic::numbers(&mesh.vert[0].Q(), mesh.vert.size(), sizeof(CVertexO));
}

/** Where a mesh keeps principal curvatures and their directions, which have to be enabled: one struct for each vertex. */
struct principal_curvatures {
  explicit principal_curvatures(CMeshO &mesh) {
    if (mesh.vert.empty()) return;
    const std::size_t count = mesh.vert.size();
    constexpr std::size_t stride = sizeof(CVertexO::CurvatureDirType);
    k1 = umbilic::numbers(&mesh.vert[0].K1(), count, stride);
    k2 = umbilic::numbers(&mesh.vert[0].K2(), count, stride);
    direction1 = umbilic::vectors(mesh.vert[0].PD1().V(), count, stride);
    direction2 = umbilic::vectors(mesh.vert[0].PD2().V(), count, stride);
  }
  umbilic::numbers k1, k2;
  umbilic::vectors direction1, direction2;
};

}  // namespace umbilic_meshlab

#endif  // UMBILIC_MESHLAB_VCG_MESH_H
