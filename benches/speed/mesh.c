#include "mesh.h"

#include <stdio.h>
#include <stdlib.h>

void *allocate(size_t bytes) {
  void *memory = malloc(bytes ? bytes : 1);
  if (!memory) {
    fputs("out of memory\n", stderr);
    exit(1);
  }
  return memory;
}

static void *read_array(FILE *file, size_t count, size_t size) {
  void *array = allocate(count * size);
  if (fread(array, size, count, file) == count) return array;
  fputs("the mesh file is too short\n", stderr);
  exit(1);
}

/* Each polygon cut from its first corner. */
static void cut(mesh *m) {
  m->triangle_count = m->corner_count - 2 * m->polygon_count;
  m->triangles = allocate(m->triangle_count * 3 * sizeof *m->triangles);
  uint32_t *triangle = m->triangles;
  for (size_t p = 0; p < m->polygon_count; p++)
    for (uint32_t corner = m->offsets[p] + 2; corner < m->offsets[p + 1]; corner++) {
      *triangle++ = m->corners[m->offsets[p]];
      *triangle++ = m->corners[corner - 1];
      *triangle++ = m->corners[corner];
    }
}

mesh read_mesh(const char *path) {
  FILE *file = fopen(path, "rb");
  if (!file) {
    perror(path);
    exit(1);
  }
  mesh m = {0};
  uint64_t *counts = read_array(file, 3, sizeof *counts);
  m.vertex_count = counts[0];
  m.polygon_count = counts[1];
  m.corner_count = counts[2];
  free(counts);
  m.positions_double = read_array(file, 3 * m.vertex_count, sizeof *m.positions_double);
  m.corners = read_array(file, m.corner_count, sizeof *m.corners);
  if (m.corner_count == 3 * m.polygon_count) {
    m.triangle_count = m.polygon_count;
    m.triangles = m.corners;
  } else {
    m.offsets = read_array(file, m.polygon_count + 1, sizeof *m.offsets);
    cut(&m);
  }
  fclose(file);
  m.positions = allocate(3 * m.vertex_count * sizeof *m.positions);
  for (size_t i = 0; i < 3 * m.vertex_count; i++) m.positions[i] = (float)m.positions_double[i];
  return m;
}

int all_quads(const mesh *m) {
  if (!m->offsets) return 0;
  for (size_t p = 0; p < m->polygon_count; p++)
    if (m->offsets[p + 1] - m->offsets[p] != 4) return 0;
  return 1;
}

void free_mesh(mesh *m) {
  if (m->triangles != m->corners) free(m->triangles);
  free(m->corners);
  free(m->offsets);
  free(m->positions);
  free(m->positions_double);
}
