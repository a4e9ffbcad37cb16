// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes of polygons as MeshLab has them: cut into triangles, in every way that there is, with faux edges between.
#ifndef UMBILIC_MESHLAB_TESTS_MESHES_H
#define UMBILIC_MESHLAB_TESTS_MESHES_H

#include <common/ml_mesh_type.h>

#include <array>
#include <random>
#include <vector>

using Polygon = std::vector<int>;

struct PolygonMesh {
  std::vector<std::array<float, 3>> positions;
  std::vector<Polygon> polygons;
};

/** A bumpy torus of hexagons, quads and triangles, or of triangles alone. */
PolygonMesh torus(int around, int across, bool triangles_only);

/** A closed box, with as many quads along each edge. */
PolygonMesh box(int parts);

/** The mesh of an OFF file; empty if it cannot be read. */
PolygonMesh read_off(const char *file);

/** How triangles follow each other. */
enum class Order { polygon_by_polygon, shuffled };

/** Fills an empty mesh. Answers with the polygon that each triangle is a part of. */
std::vector<int> fill(CMeshO &mesh, const PolygonMesh &from, Order order, unsigned seed);

/** Adds a triangle whose edges are faux where a bit is set. */
void add_triangle(CMeshO &mesh, std::array<int, 3> corners, unsigned faux);

void add_vertices(CMeshO &mesh, const std::vector<std::array<float, 3>> &positions);

#endif  // UMBILIC_MESHLAB_TESTS_MESHES_H
