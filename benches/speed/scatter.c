#include "scatter.h"

#include <math.h>
#include <string.h>

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
