// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes for the tests of the MeshLab plugin.
#include "meshes.h"

#include <vcg/complex/allocate.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <string>

namespace {

struct Triangle {
  std::array<int, 3> corners;
  unsigned faux;
  int polygon;
};

/** Cuts a run of a polygon's corners at a corner of chance, and again what is on both sides. */
void cut(const Polygon &polygon, std::size_t from, std::size_t to, int number, std::mt19937 &random, std::vector<Triangle> &triangles) {
  if (to - from < 2) return;
  const std::size_t apex = from + 1 + random() % (to - from - 1);
  const std::array<int, 3> corners = {polygon[from], polygon[apex], polygon[to]};
  const bool closes = from == 0 && to == polygon.size() - 1;
  const unsigned faux = (apex - from > 1 ? 1U : 0U) | (to - apex > 1 ? 2U : 0U) | (closes ? 0U : 4U);
  // Which corner comes first is chance as well.
  const unsigned turn = random() % 3;
  Triangle triangle = {corners, faux, number};
  for (unsigned k = 0; k < 3; k++) triangle.corners[k] = corners[(k + turn) % 3];
  triangle.faux = ((faux >> turn) | (faux << (3 - turn))) & 7U;
  triangles.push_back(triangle);
  cut(polygon, from, apex, number, random, triangles);
  cut(polygon, apex, to, number, random, triangles);
}

}  // namespace

PolygonMesh torus(int around, int across, bool triangles_only) {
  PolygonMesh mesh;
  std::mt19937 random(1);
  for (int i = 0; i < around; i++) {
    for (int j = 0; j < across; j++) {
      const double u = 2 * M_PI * i / around, v = 2 * M_PI * j / across;
      const double r = 0.4 + 0.05 * std::sin(5 * u) * std::cos(3 * v) + 0.002 * (random() % 1000) / 1000.0;
      mesh.positions.push_back({static_cast<float>((1 + r * std::cos(v)) * std::cos(u)), static_cast<float>((1 + r * std::cos(v)) * std::sin(u)),
                                static_cast<float>(r * std::sin(v))});
    }
  }
  const auto at = [&](int i, int j) { return i % around * across + j % across; };
  for (int i = 0; i < around; i++) {
    for (int j = 0; j < across; j++) {
      const Polygon quad = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      if (triangles_only || j % 4 == 2) {
        mesh.polygons.push_back({quad[0], quad[1], quad[2]});
        mesh.polygons.push_back({quad[0], quad[2], quad[3]});
      } else if (j % 4 == 0 && i % 3 < 2 && i / 3 < around / 3) {
        if (i % 3 == 0) mesh.polygons.push_back({at(i, j), at(i + 1, j), at(i + 2, j), at(i + 2, j + 1), at(i + 1, j + 1), at(i, j + 1)});
      } else {
        mesh.polygons.push_back(quad);
      }
    }
  }
  return mesh;
}

PolygonMesh box(int parts) {
  PolygonMesh mesh;
  std::map<std::array<int, 3>, int> numbers;
  const auto vertex = [&](std::array<int, 3> place) {
    const auto found = numbers.emplace(place, static_cast<int>(mesh.positions.size()));
    if (found.second) mesh.positions.push_back({static_cast<float>(place[0]), static_cast<float>(place[1]), static_cast<float>(place[2])});
    return found.first->second;
  };
  for (int axis = 0; axis < 3; axis++) {
    for (const int side : {0, parts}) {
      for (int i = 0; i < parts; i++) {
        for (int j = 0; j < parts; j++) {
          Polygon quad;
          for (const auto &step : {std::array<int, 2>{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            std::array<int, 3> place;
            place[axis] = side;
            place[(axis + 1) % 3] = i + step[0];
            place[(axis + 2) % 3] = j + step[1];
            quad.push_back(vertex(place));
          }
          if (side == 0) std::reverse(quad.begin(), quad.end());
          mesh.polygons.push_back(quad);
        }
      }
    }
  }
  return mesh;
}

PolygonMesh read_off(const char *file) {
  std::ifstream stream(file);
  std::string header;
  std::size_t vertices = 0, faces = 0, edges = 0;
  stream >> header >> std::ws;
  while (stream.peek() == '#') stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n') >> std::ws;
  stream >> vertices >> faces >> edges;
  PolygonMesh mesh;
  mesh.positions.resize(vertices);
  for (auto &position : mesh.positions) stream >> position[0] >> position[1] >> position[2];
  mesh.polygons.resize(faces);
  for (Polygon &polygon : mesh.polygons) {
    std::size_t corners = 0;
    stream >> corners;
    polygon.resize(stream ? corners : 0);
    for (int &corner : polygon) stream >> corner;
    stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return stream && header == "OFF" ? mesh : PolygonMesh();
}

std::vector<int> fill(CMeshO &mesh, const PolygonMesh &from, Order order, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Triangle> triangles;
  for (std::size_t number = 0; number < from.polygons.size(); number++) {
    const Polygon &polygon = from.polygons[number];
    cut(polygon, 0, polygon.size() - 1, static_cast<int>(number), random, triangles);
  }
  if (order == Order::shuffled) std::shuffle(triangles.begin(), triangles.end(), random);
  add_vertices(mesh, from.positions);
  std::vector<int> polygon_of;
  for (const Triangle &triangle : triangles) {
    add_triangle(mesh, triangle.corners, triangle.faux);
    polygon_of.push_back(triangle.polygon);
  }
  return polygon_of;
}

void add_vertices(CMeshO &mesh, const std::vector<std::array<float, 3>> &positions) {
  for (const auto &position : positions) {
    vcg::tri::Allocator<CMeshO>::AddVertex(mesh, Point3m(position[0], position[1], position[2]));
  }
}

void add_triangle(CMeshO &mesh, std::array<int, 3> corners, unsigned faux) {
  // MeshLab's readers make such triangles as well, its own way of adding one refuses them: those that name a vertex twice.
  CFaceO &face = *vcg::tri::Allocator<CMeshO>::AddFaces(mesh, 1);
  for (int k = 0; k < 3; k++) {
    face.V(k) = &mesh.vert[static_cast<std::size_t>(corners[static_cast<std::size_t>(k)])];
    if (faux >> k & 1U) face.SetF(k);
  }
}
