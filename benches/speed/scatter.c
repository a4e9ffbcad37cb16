#include "scatter.h"

#include <math.h>
#include <string.h>

static inline void add_to(float *normals, const uint32_t *corners, int count, const float n[3]) {
  for (int corner = 0; corner < count; corner++)
    for (int i = 0; i < 3; i++) normals[3 * (size_t)corners[corner] + (size_t)i] += n[i];
}

static inline void normalise(float *normals, size_t vertex_count) {
  for (size_t v = 0; v < vertex_count; v++) {
    float *n = normals + 3 * v;
    float squared = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    float scale = squared > 0 ? 1 / sqrtf(squared) : 0;
    for (int i = 0; i < 3; i++) n[i] *= scale;
  }
}

void scatter_area(const mesh *m, float *normals) {
  memset(normals, 0, m->vertex_count * 3 * sizeof(float));
  for (size_t f = 0; f < m->triangle_count; f++) {
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
    add_to(normals, t, 3, n);
  }
  normalise(normals, m->vertex_count);
}

void scatter_quads(const mesh *m, float *normals) {
  memset(normals, 0, m->vertex_count * 3 * sizeof(float));
  for (size_t q = 0; q < m->polygon_count; q++) {
    const uint32_t *corners = m->corners + 4 * q;
    const float *a = m->positions + 3 * (size_t)corners[0], *b = m->positions + 3 * (size_t)corners[1];
    const float *c = m->positions + 3 * (size_t)corners[2], *d = m->positions + 3 * (size_t)corners[3];
    float u[3], v[3], n[3];
    for (int i = 0; i < 3; i++) {
      u[i] = c[i] - a[i];
      v[i] = d[i] - b[i];
    }
    n[0] = u[1] * v[2] - u[2] * v[1];
    n[1] = u[2] * v[0] - u[0] * v[2];
    n[2] = u[0] * v[1] - u[1] * v[0];
    add_to(normals, corners, 4, n);
  }
  normalise(normals, m->vertex_count);
}
