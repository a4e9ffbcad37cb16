/* Meshes as the benchmarks read them: from files that generate_mesh.c writes, so that all programs see the same ones. */
#ifndef UMBILIC_BENCHES_MESH_H
#define UMBILIC_BENCHES_MESH_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mesh {
  size_t vertex_count, polygon_count, corner_count, triangle_count;
  float *positions;
  double *positions_double;
  uint32_t *corners;   /* of the polygons, one after the other */
  uint32_t *offsets;   /* where each polygon starts, and the end of the last; null if all are triangles */
  uint32_t *triangles; /* the polygons cut from their first corners; `corners` if all are triangles */
} mesh;

/* These end the program when something fails. */
void *allocate(size_t bytes);
mesh read_mesh(const char *path);

/* Whether each polygon has four corners. */
int all_quads(const mesh *m);

void free_mesh(mesh *m);

#ifdef __cplusplus
}
#endif

#endif
