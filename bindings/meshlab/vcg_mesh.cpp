// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faces of a MeshLab mesh as polygons: its triangles, joined across the edges that are marked as faux.
//
// A halfedge is numbered by its triangle and its place there, 3 f + k, and runs from V(k) to the next corner.
#include "vcg_mesh.h"

#include <vcg/complex/allocate.h>

namespace umbilic_meshlab {

namespace {

using Number = std::uint32_t;
constexpr Number NONE = std::numeric_limits<Number>::max();

std::size_t vertex(const CMeshO &mesh, std::size_t halfedge) {
  return vcg::tri::Index(mesh, mesh.face[halfedge / 3].cV(static_cast<int>(halfedge % 3)));
}

std::size_t next(std::size_t halfedge) { return halfedge % 3 == 2 ? halfedge - 2 : halfedge + 1; }

/** For each halfedge the one on the other side of its faux edge, or `NONE`. Of several, those that come first in the mesh are joined. */
std::vector<Number> faux_mates(const CMeshO &mesh) {
  if (mesh.face.size() > NONE / 3) throw std::length_error("more triangles than tables of 32 bits can hold");
  std::vector<Number> mates(3 * mesh.face.size(), NONE);
  // Faux halfedges without a mate so far, in a list for each lower vertex.
  std::vector<Number> first(mesh.vert.size(), NONE);
  std::vector<Number> following(mates.size(), NONE);
  for (std::size_t halfedge = 0; halfedge < mates.size(); halfedge++) {
    if (!mesh.face[halfedge / 3].IsF(static_cast<int>(halfedge % 3))) continue;
    const std::size_t from = vertex(mesh, halfedge), to = vertex(mesh, next(halfedge));
    if (from == to) continue;
    Number *place = &first[std::min(from, to)];
    while (*place != NONE && (vertex(mesh, *place) != to || vertex(mesh, next(*place)) != from)) place = &following[*place];
    if (*place == NONE) {
      *place = static_cast<Number>(halfedge);
    } else {
      mates[halfedge] = *place;
      mates[*place] = static_cast<Number>(halfedge);
      *place = following[*place];
    }
  }
  return mates;
}

/** Adds polygons, and marks all their triangles with their numbers. */
class polygon_joiner {
 public:
  polygon_joiner(const CMeshO &mesh, mesh_faces &into) : mesh_(mesh), mates_(faux_mates(mesh)), into_(into) {
    into_.face_of.assign(mesh.face.size(), NONE);
  }

  /** That of a triangle, unless it has been added. */
  void add(std::size_t triangle) {
    if (into_.face_of[triangle] != NONE) return;
    gather(triangle);
    if (!is_disk()) take_apart(triangle);
    add_outline();
    number_++;
  }

 private:
  /** All triangles that are joined with one. */
  void gather(std::size_t triangle) {
    parts_.assign(1, static_cast<Number>(triangle));
    into_.face_of[triangle] = number_;
    joints_ = 0;
    for (std::size_t i = 0; i < parts_.size(); i++) {
      for (std::size_t k = 0; k < 3; k++) {
        const Number mate = mates_[3 * std::size_t{parts_[i]} + k];
        if (mate == NONE) continue;
        joints_++;
        if (into_.face_of[mate / 3] != NONE) continue;
        into_.face_of[mate / 3] = number_;
        parts_.push_back(mate / 3);
      }
    }
  }

  /** Whether they hang together as a tree: else there is a vertex or a hole amid them. Each joint was counted from both sides. */
  bool is_disk() const { return joints_ == 2 * (parts_.size() - 1); }

  /** Leaves each a triangle, those after this one for later. */
  void take_apart(std::size_t triangle) {
    for (const Number part : parts_) {
      into_.face_of[part] = NONE;
      for (std::size_t k = 0; k < 3; k++) mates_[3 * std::size_t{part} + k] = NONE;
    }
    parts_.assign(1, static_cast<Number>(triangle));
    into_.face_of[triangle] = number_;
  }

  void add_outline() {
    std::size_t part = 0, start = 3 * std::size_t{parts_[0]};
    while (mates_[start] != NONE) start = start % 3 == 2 ? 3 * std::size_t{parts_[++part]} : start + 1;
    std::size_t halfedge = start;
    do {
      into_.polygons.add_corner(vertex(mesh_, halfedge));
      halfedge = next(halfedge);
      while (mates_[halfedge] != NONE) halfedge = next(mates_[halfedge]);
    } while (halfedge != start);
    into_.polygons.end_face();
  }

  const CMeshO &mesh_;
  std::vector<Number> mates_;
  mesh_faces &into_;
  std::vector<Number> parts_;
  std::size_t joints_ = 0;
  Number number_ = 0;
};

mesh_faces joined(const CMeshO &mesh) {
  mesh_faces found;
  found.polygons.reserve(3 * mesh.face.size());
  polygon_joiner joiner(mesh, found);
  for (std::size_t triangle = 0; triangle < mesh.face.size(); triangle++) joiner.add(triangle);
  return found;
}

}  // namespace

void compact(CMeshO &mesh) { vcg::tri::Allocator<CMeshO>::CompactEveryVector(mesh); }

mesh_faces faces_of(const CMeshO &mesh) {
  mesh_faces found;
  found.polygons.reserve(3 * mesh.face.size());
  for (const CFaceO &face : mesh.face) {
    if (face.IsAnyF()) return joined(mesh);
    for (int k = 0; k < 3; k++) found.polygons.add_corner(vcg::tri::Index(mesh, face.cV(k)));
    found.polygons.end_face();
  }
  return found;
}

}  // namespace umbilic_meshlab
