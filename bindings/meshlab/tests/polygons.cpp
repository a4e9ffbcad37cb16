// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles and faux edges become the polygons that they were made of, however these were cut; what is no polygon stays triangles.
#include "check.h"
#include "meshes.h"
#include "vcg_mesh.h"

#include <algorithm>

using umbilic_meshlab::faces_of;
using umbilic_meshlab::mesh_faces;

namespace {

std::vector<Polygon> loops_of(const mesh_faces &found) {
  const umbilic::faces view = found.polygons;
  const auto *indices = static_cast<const std::uint32_t *>(view.indices), *offsets = static_cast<const std::uint32_t *>(view.offsets);
  std::vector<Polygon> loops;
  for (std::size_t face = 0; face < view.size(); face++) {
    const std::size_t begin = offsets ? offsets[face] : 3 * face, end = offsets ? offsets[face + 1] : 3 * face + 3;
    loops.emplace_back(indices + begin, indices + end);
  }
  return loops;
}

/** The same loop from its lowest corner on. */
Polygon turned(Polygon loop) {
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

void polygons_come_back(const PolygonMesh &from, Order order, unsigned seed) {
  CMeshO mesh;
  const std::vector<int> polygon_of = fill(mesh, from, order, seed);
  const mesh_faces found = faces_of(mesh);
  const std::vector<Polygon> loops = loops_of(found);
  CHECK(loops.size() == from.polygons.size(), "%zu faces of %zu polygons", loops.size(), from.polygons.size());
  std::size_t seen = 0;
  for (std::size_t triangle = 0; triangle < polygon_of.size(); triangle++) {
    const std::size_t face = found.face(triangle);
    // Numbered by their first triangles.
    CHECK(face <= seen, "face %zu of triangle %zu", face, triangle);
    if (face == seen) seen++;
    const Polygon &polygon = from.polygons[static_cast<std::size_t>(polygon_of[triangle])];
    CHECK(face < loops.size() && turned(loops[face]) == turned(polygon), "the polygon of triangle %zu", triangle);
  }
}

const std::vector<std::array<float, 3>> NINE = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}};

void many_edges_at_one_vertex(int corners) {
  PolygonMesh one;
  one.positions.resize(static_cast<std::size_t>(corners));
  CMeshO mesh;
  add_vertices(mesh, one.positions);
  const int triangles = corners - 2;
  for (int i = 0; i < triangles; i++) {
    // All even triangles of a fan before the odd ones.
    const int place = 2 * i < triangles ? 2 * i : 2 * (i - (triangles + 1) / 2) + 1;
    add_triangle(mesh, {0, place + 1, place + 2}, (place > 0 ? 1U : 0U) | (place < triangles - 1 ? 4U : 0U));
  }
  const std::vector<Polygon> loops = loops_of(faces_of(mesh));
  CHECK(loops.size() == 1 && loops[0].size() == static_cast<std::size_t>(corners), "%zu faces", loops.size());
}

struct Part {
  std::array<int, 3> corners;
  unsigned faux;
};

void expect(const char *what, const std::vector<Part> &parts, const std::vector<Polygon> &expected) {
  CMeshO mesh;
  add_vertices(mesh, NINE);
  for (const Part &part : parts) add_triangle(mesh, part.corners, part.faux);
  CHECK(loops_of(faces_of(mesh)) == expected, "%s", what);
}

}  // namespace

int main() {
  for (unsigned seed = 0; seed < 20; seed++) {
    for (const Order order : {Order::polygon_by_polygon, Order::shuffled}) {
      polygons_come_back(torus(12, 8, false), order, seed);
      polygons_come_back(torus(6, 5, true), order, seed);
      polygons_come_back(box(2), order, seed);
      PolygonMesh one;
      one.positions.resize(40);
      one.polygons.emplace_back();
      for (int corner = 0; corner < 40; corner++) one.polygons[0].push_back(corner);
      polygons_come_back(one, order, seed);
    }
  }
  // At one vertex, and in an order that finds nothing soon: in time that is not by the square.
  many_edges_at_one_vertex(300000);
  expect("nothing", {}, {});
  expect("a quad", {{{0, 1, 4}, 4}, {{0, 4, 3}, 1}}, {{0, 1, 4, 3}});
  expect("a faux edge on the border", {{{0, 1, 4}, 1}}, {{0, 1, 4}});
  expect("an edge that is faux on one side", {{{0, 1, 4}, 4}, {{0, 4, 3}, 0}}, {{0, 1, 4}, {0, 4, 3}});
  expect("triangles that run through the edge in one direction", {{{0, 1, 4}, 4}, {{4, 0, 3}, 1}}, {{0, 1, 4}, {4, 0, 3}});
  expect("three triangles at a faux edge", {{{0, 1, 4}, 4}, {{0, 4, 3}, 1}, {{0, 4, 6}, 1}}, {{0, 1, 4, 3}, {0, 4, 6}});
  expect("the same quad twice", {{{0, 1, 4}, 4}, {{0, 4, 3}, 1}, {{0, 1, 4}, 4}, {{0, 4, 3}, 1}}, {{0, 1, 4, 3}, {0, 1, 4, 3}});
  expect("both sides of a quad", {{{0, 1, 4}, 4}, {{0, 4, 3}, 1}, {{4, 1, 0}, 4}, {{4, 0, 3}, 1}}, {{0, 1, 4, 3}, {4, 1, 0, 3}});
  expect("a vertex amid faux edges", {{{0, 2, 4}, 6}, {{2, 8, 4}, 6}, {{8, 6, 4}, 6}, {{6, 0, 4}, 6}},
         {{0, 2, 4}, {2, 8, 4}, {8, 6, 4}, {6, 0, 4}});
  expect("a triangle that is all faux comes first", {{{0, 4, 6}, 7}, {{0, 2, 4}, 4}, {{4, 8, 6}, 4}, {{6, 3, 0}, 4}}, {{0, 2, 4, 8, 6, 3}});
  expect("a triangle with an edge without length", {{{0, 0, 1}, 1}}, {{0, 0, 1}});
  return outcome("polygons");
}
