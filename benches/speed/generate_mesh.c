/* Writes a mesh to a file that read_mesh (mesh.h) reads.
 *
 *   generate_mesh sphere SUBDIVISIONS FILE       an icosphere with bumps: every vertex has valence 5 or 6
 *   generate_mesh shuffled SUBDIVISIONS FILE     the same, vertices and faces in an order drawn at random
 *   generate_mesh torus COLUMNS FILE             irregular triangles, COLUMNS x 2/5 COLUMNS cells: valence up to 8
 *   generate_mesh quads COLUMNS FILE             the same torus of quadrilaterals alone: every vertex has valence 4
 *   generate_mesh quad-dominant COLUMNS FILE     the same, one in eight cut into two triangles
 *
 * The file has the numbers of vertices, polygons and corners (64 bits each), the positions (double), the corners, and
 * unless all polygons are triangles, where each starts and the last ends (32 bits each). */
#include "mesh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t random_state = 1;
static double uniform(void) { /* xorshift: the same meshes everywhere */
  random_state ^= random_state << 13;
  random_state ^= random_state >> 7;
  random_state ^= random_state << 17;
  return (double)(random_state >> 11) / 9007199254740992.0;
}

/* ---- sphere ---- */

/* The vertex halfway along an edge, made when first asked for; edges are found through a small open-addressed table. */
typedef struct edge_table {
  uint64_t *keys;
  uint32_t *vertices;
  size_t mask;
} edge_table;

static uint32_t midpoint(edge_table *table, double *positions, size_t *vertex_count, uint32_t a, uint32_t b) {
  uint64_t key = a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
  size_t slot = (size_t)((key * 0x9e3779b97f4a7c15u) >> 20) & table->mask;
  while (table->keys[slot] != UINT64_MAX) {
    if (table->keys[slot] == key) return table->vertices[slot];
    slot = (slot + 1) & table->mask;
  }
  double *p = positions + 3 * *vertex_count, length = 0;
  for (int i = 0; i < 3; i++) {
    p[i] = positions[3 * (size_t)a + (size_t)i] + positions[3 * (size_t)b + (size_t)i];
    length += p[i] * p[i];
  }
  for (int i = 0; i < 3; i++) p[i] /= sqrt(length);
  table->keys[slot] = key;
  return table->vertices[slot] = (uint32_t)(*vertex_count)++;
}

static mesh bumpy_sphere(int subdivisions) {
  static const uint32_t icosahedron[60] = {0, 11, 5, 0, 5,  1,  0,  1,  7,  0,  7, 10, 0, 10, 11, 1, 5, 9, 5, 11,
                                           4, 11, 10, 2, 10, 7, 6,  7,  1,  8,  3, 9,  4, 3,  4,  2, 3, 2, 6, 3,
                                           6, 8,  3,  8, 9,  4, 9,  5,  2,  4,  11, 6, 2, 10, 8,  6, 7, 9, 8, 1};
  const double g = (1 + sqrt(5.0)) / 2, l = sqrt(1 + g * g);
  const double corners[36] = {-1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, 0, 0, -1, g, 0, 1, g,
                              0, -1, -g, 0, 1, -g, g, 0, -1, g, 0, 1, -g, 0, -1, -g, 0, 1};
  mesh m = {0};
  size_t faces = 20;
  for (int s = 0; s < subdivisions; s++) faces *= 4;
  m.positions_double = allocate((faces / 2 + 2) * 3 * sizeof(double));
  m.corners = allocate(faces * 3 * sizeof(uint32_t));
  uint32_t *coarse = allocate(faces * 3 * sizeof(uint32_t));
  for (int i = 0; i < 36; i++) m.positions_double[i] = corners[i] / l;
  memcpy(m.corners, icosahedron, sizeof icosahedron);
  m.vertex_count = 12;
  m.polygon_count = 20;
  for (int s = 0; s < subdivisions; s++) {
    size_t size = 1;
    while (size < 4 * m.polygon_count) size *= 2;
    edge_table table = {allocate(size * sizeof(uint64_t)), allocate(size * sizeof(uint32_t)), size - 1};
    memset(table.keys, 0xff, size * sizeof(uint64_t));
    memcpy(coarse, m.corners, m.polygon_count * 3 * sizeof(uint32_t));
    for (size_t f = 0; f < m.polygon_count; f++) {
      uint32_t a = coarse[3 * f], b = coarse[3 * f + 1], c = coarse[3 * f + 2];
      uint32_t ab = midpoint(&table, m.positions_double, &m.vertex_count, a, b);
      uint32_t bc = midpoint(&table, m.positions_double, &m.vertex_count, b, c);
      uint32_t ca = midpoint(&table, m.positions_double, &m.vertex_count, c, a);
      const uint32_t fine[12] = {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca};
      memcpy(m.corners + 12 * f, fine, sizeof fine);
    }
    m.polygon_count *= 4;
    free(table.keys);
    free(table.vertices);
  }
  free(coarse);
  for (size_t v = 0; v < m.vertex_count; v++) {
    double *p = m.positions_double + 3 * v;
    double radius = 1 + 0.08 * sin(5 * p[0]) * sin(4 * p[1] + 1) * sin(6 * p[2]);
    for (int i = 0; i < 3; i++) p[i] *= radius;
  }
  m.corner_count = 3 * m.polygon_count;
  return m;
}

static mesh shuffled(mesh m) {
  mesh s = m;
  s.positions_double = allocate(m.vertex_count * 3 * sizeof(double));
  s.corners = allocate(m.corner_count * sizeof(uint32_t));
  uint32_t *place = allocate(m.vertex_count * sizeof(uint32_t));
  for (size_t v = 0; v < m.vertex_count; v++) {
    size_t other = (size_t)(uniform() * (double)(v + 1));
    place[v] = place[other];
    place[other] = (uint32_t)v;
  }
  for (size_t v = 0; v < m.vertex_count; v++)
    memcpy(s.positions_double + 3 * (size_t)place[v], m.positions_double + 3 * v, 3 * sizeof(double));
  for (size_t f = 0; f < m.polygon_count; f++) {
    size_t other = (size_t)(uniform() * (double)(f + 1));
    memcpy(s.corners + 3 * f, s.corners + 3 * other, 3 * sizeof(uint32_t));
    for (int i = 0; i < 3; i++) s.corners[3 * other + (size_t)i] = place[m.corners[3 * f + (size_t)i]];
  }
  free(place);
  free_mesh(&m);
  return s;
}

/* ---- torus ---- */

/* A grid with jittered parameters. A cell is left whole with the probability `whole`, or else cut along a diagonal that
 * is drawn at random. */
static mesh torus(size_t columns, double whole) {
  size_t rows = columns * 2 / 5, cells = columns * rows;
  mesh m = {.vertex_count = cells};
  m.positions_double = allocate(cells * 3 * sizeof(double));
  m.corners = allocate(cells * 6 * sizeof(uint32_t));
  m.offsets = allocate((2 * cells + 1) * sizeof(uint32_t));
  const double turn = 2 * acos(-1.0);
  for (size_t i = 0; i < columns; i++)
    for (size_t j = 0; j < rows; j++) {
      double u = turn * ((double)i + 0.44 * (uniform() - 0.5)) / (double)columns;
      double v = turn * ((double)j + 0.44 * (uniform() - 0.5)) / (double)rows;
      double *p = m.positions_double + 3 * (i * rows + j);
      p[0] = (1 + 0.4 * cos(v)) * cos(u);
      p[1] = (1 + 0.4 * cos(v)) * sin(u);
      p[2] = 0.4 * sin(v);
      uint32_t a = (uint32_t)(i * rows + j), d = (uint32_t)(i * rows + (j + 1) % rows);
      uint32_t b = (uint32_t)((i + 1) % columns * rows + j), c = (uint32_t)((i + 1) % columns * rows + (j + 1) % rows);
      const uint32_t cell[3][6] = {{a, b, c, d, 0, 0}, {a, b, c, a, c, d}, {a, b, d, b, c, d}};
      int kind = uniform() < whole ? 0 : uniform() < 0.5 ? 1 : 2;
      memcpy(m.corners + m.corner_count, cell[kind], sizeof cell[kind]);
      m.offsets[m.polygon_count++] = (uint32_t)m.corner_count;
      if (kind) m.offsets[m.polygon_count++] = (uint32_t)m.corner_count + 3;
      m.corner_count += kind ? 6 : 4;
    }
  m.offsets[m.polygon_count] = (uint32_t)m.corner_count;
  return m;
}

/* ---- files ---- */

static void write_array(FILE *file, const void *array, size_t count, size_t size) {
  if (fwrite(array, size, count, file) == count) return;
  perror("the mesh file");
  exit(1);
}

int main(int argc, char **argv) {
  int size = argc == 4 ? atoi(argv[2]) : 0;
  if (size < 1) {
    fprintf(stderr, "usage: %s sphere|shuffled|torus|quads|quad-dominant SIZE FILE\n", argv[0]);
    return 2;
  }
  mesh m;
  if (!strcmp(argv[1], "sphere")) m = bumpy_sphere(size);
  else if (!strcmp(argv[1], "shuffled")) m = shuffled(bumpy_sphere(size));
  else if (!strcmp(argv[1], "torus")) m = torus((size_t)size, 0);
  else if (!strcmp(argv[1], "quads")) m = torus((size_t)size, 1);
  else if (!strcmp(argv[1], "quad-dominant")) m = torus((size_t)size, 7.0 / 8);
  else {
    fprintf(stderr, "there is no mesh '%s'\n", argv[1]);
    return 2;
  }
  FILE *file = fopen(argv[3], "wb");
  if (!file) {
    perror(argv[3]);
    return 1;
  }
  const uint64_t counts[3] = {m.vertex_count, m.polygon_count, m.corner_count};
  write_array(file, counts, 3, sizeof *counts);
  write_array(file, m.positions_double, 3 * m.vertex_count, sizeof *m.positions_double);
  write_array(file, m.corners, m.corner_count, sizeof *m.corners);
  if (m.corner_count != 3 * m.polygon_count) write_array(file, m.offsets, m.polygon_count + 1, sizeof *m.offsets);
  if (fclose(file)) perror(argv[3]);
  free_mesh(&m);
  return 0;
}
