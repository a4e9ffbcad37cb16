/* A program of a user's: prints normals and principal curvatures of a torus, to the last bit, as consumer.cpp does. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <umbilic.h>

enum { AROUND = 24, ACROSS = 12, VERTICES = AROUND * ACROSS };

static double positions[VERTICES][3], normals[VERTICES][3], k1[VERTICES], k2[VERTICES];
static uint32_t triangles[2 * VERTICES][3];

static void make_torus(void) {
  for (uint32_t v = 0; v < VERTICES; v++) {
    uint32_t i = v / ACROSS, j = v % ACROSS;
    uint32_t i1 = (i + 1) % AROUND * ACROSS, j1 = (j + 1) % ACROSS;
    double u = 6.283185307179586 * i / AROUND, w = 6.283185307179586 * j / ACROSS;
    positions[v][0] = cos(u) * (1.0 + 0.4 * cos(w));
    positions[v][1] = sin(u) * (1.0 + 0.4 * cos(w));
    positions[v][2] = 0.4 * sin(w);
    triangles[2 * v][0] = v, triangles[2 * v][1] = i1 + j, triangles[2 * v][2] = i1 + j1;
    triangles[2 * v + 1][0] = v, triangles[2 * v + 1][1] = i1 + j1, triangles[2 * v + 1][2] = i * ACROSS + j1;
  }
}

int main(void) {
  umb_faces faces = {.indices = triangles, .index_count = 6 * VERTICES};
  umb_points points = {.data = positions, .count = VERTICES, .scalar = UMB_SCALAR_F64};
  umb_normal_outputs normal_outputs = {.normal = {.data = normals, .scalar = UMB_SCALAR_F64}};
  umb_curvature_outputs curvature_outputs = {
      .k1 = {.data = k1, .scalar = UMB_SCALAR_F64}, .k2 = {.data = k2, .scalar = UMB_SCALAR_F64}};
  umb_topology *mesh;

  if (umb_abi_version() != UMB_ABI_VERSION || strcmp(umb_version(), VERSION) != 0) return 1;
  make_torus();
  if (umb_topology_create(&faces, VERTICES, NULL, &mesh, NULL) != UMB_OK) return 1;
  if (umb_vertex_normals(mesh, &points, NULL, &normal_outputs, NULL) != UMB_OK) return 1;
  if (umb_curvatures(mesh, &points, NULL, &curvature_outputs, NULL) != UMB_OK) return 1;
  umb_topology_destroy(mesh);
  for (int v = 0; v < VERTICES; v++) printf("%a %a %a %a %a\n", normals[v][0], normals[v][1], normals[v][2], k1[v], k2[v]);
  return 0;
}
