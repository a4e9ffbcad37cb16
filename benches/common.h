/* What the benchmarks share: generated meshes, the plain C scatter loop that all is measured against, and timing.
 *
 * The reference adds each triangle's cross product to its three vertices and normalises (area weights, no checks,
 * float), compiled with `cc -O3 -march=native`. Meshes are an icosphere with bumps (every vertex has valence 5 or 6)
 * in the order in which it is made, the same with vertices and faces shuffled, and an irregular torus (valence up to
 * 10 or so, drawn at random). */
#ifndef UMBILIC_BENCHES_COMMON_H
#define UMBILIC_BENCHES_COMMON_H

#include "umbilic.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct mesh {
  const char *name;
  size_t vertex_count, face_count;
  float *positions;
  double *positions_double;
  uint32_t *triangles;
} mesh;

static inline void *allocate(size_t bytes) {
  void *memory = malloc(bytes);
  if (!memory) {
    fputs("out of memory\n", stderr);
    exit(1);
  }
  return memory;
}

/* ---- the reference ---- */

static inline void scatter_area(const mesh *m, float *normals) {
  memset(normals, 0, m->vertex_count * 3 * sizeof(float));
  for (size_t f = 0; f < m->face_count; f++) {
    const uint32_t *t = m->triangles + 3 * f;
    const float *a = m->positions + 3 * (size_t)t[0], *b = m->positions + 3 * (size_t)t[1];
    const float *c = m->positions + 3 * (size_t)t[2];
    float u[3], v[3], n[3];
    for (int i = 0; i < 3; i++) {
      u[i] = b[i] - a[i];
      v[i] = c[i] - a[i];
    }
    n[0] = u[1] * v[2] - u[2] * v[1];
    n[1] = u[2] * v[0] - u[0] * v[2];
    n[2] = u[0] * v[1] - u[1] * v[0];
    for (int corner = 0; corner < 3; corner++)
      for (int i = 0; i < 3; i++) normals[3 * (size_t)t[corner] + (size_t)i] += n[i];
  }
  for (size_t v = 0; v < m->vertex_count; v++) {
    float *n = normals + 3 * v;
    float squared = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    float scale = squared > 0 ? 1 / sqrtf(squared) : 0;
    for (int i = 0; i < 3; i++) n[i] *= scale;
  }
}

/* ---- meshes ---- */

static uint64_t random_state = 1;
static inline double uniform(void) { /* xorshift: the same meshes everywhere */
  random_state ^= random_state << 13;
  random_state ^= random_state >> 7;
  random_state ^= random_state << 17;
  return (double)(random_state >> 11) / 9007199254740992.0;
}

/* The vertex halfway along an edge, made when first asked for; edges are found through a small open-addressed table. */
typedef struct edge_table {
  uint64_t *keys;
  uint32_t *vertices;
  size_t mask;
} edge_table;

static inline uint32_t midpoint(edge_table *table, double *positions, size_t *vertex_count, uint32_t a, uint32_t b) {
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

static inline void finish_mesh(mesh *m) {
  m->positions = allocate(m->vertex_count * 3 * sizeof(float));
  for (size_t i = 0; i < 3 * m->vertex_count; i++) m->positions[i] = (float)m->positions_double[i];
}

static inline mesh bumpy_sphere(int subdivisions) {
  static const uint32_t icosahedron[60] = {0, 11, 5, 0, 5,  1,  0,  1,  7,  0,  7, 10, 0, 10, 11, 1, 5, 9, 5, 11,
                                           4, 11, 10, 2, 10, 7, 6,  7,  1,  8,  3, 9,  4, 3,  4,  2, 3, 2, 6, 3,
                                           6, 8,  3,  8, 9,  4, 9,  5,  2,  4,  11, 6, 2, 10, 8,  6, 7, 9, 8, 1};
  const double g = (1 + sqrt(5.0)) / 2, l = sqrt(1 + g * g);
  const double corners[36] = {-1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, 0, 0, -1, g, 0, 1, g,
                              0, -1, -g, 0, 1, -g, g, 0, -1, g, 0, 1, -g, 0, -1, -g, 0, 1};
  mesh m = {.name = "bumpy sphere"};
  size_t faces = 20;
  for (int s = 0; s < subdivisions; s++) faces *= 4;
  m.positions_double = allocate((faces / 2 + 2) * 3 * sizeof(double));
  m.triangles = allocate(faces * 3 * sizeof(uint32_t));
  uint32_t *coarse = allocate(faces * 3 * sizeof(uint32_t));
  for (int i = 0; i < 36; i++) m.positions_double[i] = corners[i] / l;
  memcpy(m.triangles, icosahedron, sizeof icosahedron);
  m.vertex_count = 12;
  m.face_count = 20;
  for (int s = 0; s < subdivisions; s++) {
    size_t size = 1;
    while (size < 4 * m.face_count) size *= 2;
    edge_table table = {allocate(size * sizeof(uint64_t)), allocate(size * sizeof(uint32_t)), size - 1};
    memset(table.keys, 0xff, size * sizeof(uint64_t));
    memcpy(coarse, m.triangles, m.face_count * 3 * sizeof(uint32_t));
    for (size_t f = 0; f < m.face_count; f++) {
      uint32_t a = coarse[3 * f], b = coarse[3 * f + 1], c = coarse[3 * f + 2];
      uint32_t ab = midpoint(&table, m.positions_double, &m.vertex_count, a, b);
      uint32_t bc = midpoint(&table, m.positions_double, &m.vertex_count, b, c);
      uint32_t ca = midpoint(&table, m.positions_double, &m.vertex_count, c, a);
      const uint32_t fine[12] = {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca};
      memcpy(m.triangles + 12 * f, fine, sizeof fine);
    }
    m.face_count *= 4;
    free(table.keys);
    free(table.vertices);
  }
  free(coarse);
  for (size_t v = 0; v < m.vertex_count; v++) {
    double *p = m.positions_double + 3 * v;
    double radius = 1 + 0.08 * sin(5 * p[0]) * sin(4 * p[1] + 1) * sin(6 * p[2]);
    for (int i = 0; i < 3; i++) p[i] *= radius;
  }
  finish_mesh(&m);
  return m;
}

static inline mesh shuffled(const mesh *m) {
  mesh s = {"the same, shuffled", m->vertex_count, m->face_count, NULL, NULL, NULL};
  s.positions_double = allocate(m->vertex_count * 3 * sizeof(double));
  s.triangles = allocate(m->face_count * 3 * sizeof(uint32_t));
  uint32_t *place = allocate(m->vertex_count * sizeof(uint32_t));
  for (size_t v = 0; v < m->vertex_count; v++) {
    size_t other = (size_t)(uniform() * (double)(v + 1));
    place[v] = place[other];
    place[other] = (uint32_t)v;
  }
  for (size_t v = 0; v < m->vertex_count; v++)
    memcpy(s.positions_double + 3 * (size_t)place[v], m->positions_double + 3 * v, 3 * sizeof(double));
  for (size_t f = 0; f < m->face_count; f++) {
    size_t other = (size_t)(uniform() * (double)(f + 1));
    memcpy(s.triangles + 3 * f, s.triangles + 3 * other, 3 * sizeof(uint32_t));
    for (int i = 0; i < 3; i++) s.triangles[3 * other + (size_t)i] = place[m->triangles[3 * f + (size_t)i]];
  }
  free(place);
  finish_mesh(&s);
  return s;
}

/* A grid on the torus with jittered parameters, and each quad cut along a diagonal drawn at random. */
static inline mesh irregular_torus(size_t columns, size_t rows) {
  mesh m = {"irregular torus", columns * rows, 2 * columns * rows, NULL, NULL, NULL};
  m.positions_double = allocate(m.vertex_count * 3 * sizeof(double));
  m.triangles = allocate(m.face_count * 3 * sizeof(uint32_t));
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
      uint32_t *t = m.triangles + 6 * (i * rows + j);
      if (uniform() < 0.5) {
        const uint32_t cut[6] = {a, b, c, a, c, d};
        memcpy(t, cut, sizeof cut);
      } else {
        const uint32_t cut[6] = {a, b, d, b, c, d};
        memcpy(t, cut, sizeof cut);
      }
    }
  finish_mesh(&m);
  return m;
}

static inline void free_mesh(mesh *m) {
  free(m->positions);
  free(m->positions_double);
  free(m->triangles);
}

/* ---- timing ---- */

static inline double seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline int ascending(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static inline double quantile(double *values, int count, double q) {
  qsort(values, (size_t)count, sizeof *values, ascending);
  return values[(int)(q * (count - 1) + 0.5)];
}

static inline void check(umb_status status, const umb_error *error) {
  if (status == UMB_OK) return;
  fprintf(stderr, "%s: %s\n", umb_status_string(status), error->message);
  exit(1);
}

/* ---- arguments ---- */

typedef struct arguments {
  int rounds, subdivisions, threads, simd;
} arguments;

static inline void parse(int argc, char **argv, arguments *given) {
  for (int i = 1; i < argc; i += 2) {
    int value = i + 1 < argc ? atoi(argv[i + 1]) : -1;
    if (!strcmp(argv[i], "--rounds") && value > 0) given->rounds = value;
    else if (!strcmp(argv[i], "--subdivide") && value >= 0) given->subdivisions = value;
    else if (!strcmp(argv[i], "--threads") && value >= 0) given->threads = value;
    else if (!strcmp(argv[i], "--simd") && value >= 0) given->simd = value;
    else {
      fprintf(stderr, "usage: %s [--rounds N] [--subdivide N] [--threads N] [--simd 0..4]\n", argv[0]);
      exit(2);
    }
  }
}

#endif
