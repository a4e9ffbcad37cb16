/*
 * Meshes cut along creases, and corner normals: every entry point that they have, on a solid with sharp edges and on broken meshes, and
 * every mistake. Run under every sanitizer; exactness is tested from Rust.
 */
#include "mesh.h"

static umb_cut *cut_of(const struct mesh *mesh, const umb_creases *creases, umb_scalar scalar) {
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh);
  umb_points points = points_of(mesh, scalar);
  umb_cut *cut = NULL;
  SUCCEEDS(umb_cut_create(&faces, &points, creases, NULL, &cut, &error));
  CHECK(umb_cut_corner_count(cut) == mesh->index_count);
  CHECK(umb_topology_vertex_count(umb_cut_topology(cut)) == umb_cut_vertex_count(cut));
  for (size_t corner = 0; corner < mesh->index_count; corner++) {
    uint32_t vertex = umb_cut_corners(cut)[corner];
    CHECK(vertex < umb_cut_vertex_count(cut) && umb_cut_origins(cut)[vertex] == mesh->indices[corner]);
  }
  return cut;
}

/* Everything that there is of a cut mesh, for every weight, in both scalars, packed and strided. */
static void every_output(const struct mesh *mesh, const umb_creases *creases) {
  static const umb_scalar scalars[2] = {UMB_SCALAR_F32, UMB_SCALAR_F64};
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh);
  for (size_t kind = 0; kind < 4; kind++) {
    /* Where angles decide, they do by the same positions. */
    umb_scalar scalar = scalars[kind % 2];
    umb_points points = points_of(mesh, scalar);
    umb_cut *cut = cut_of(mesh, creases, scalar);
    size_t count = umb_cut_vertex_count(cut), gap = kind / 2 * 3;
    unsigned char *status = (unsigned char *)memory(count);
    for (umb_weight weight = UMB_WEIGHT_CONFORMAL; weight <= UMB_WEIGHT_TILTED_SECTIONS; weight++) {
      struct array corners = array_of(mesh->index_count, 3, gap, scalar);
      struct array once = array_of(mesh->index_count, 3, gap, scalar);
      struct array normals = array_of(count, 3, gap, scalar);
      struct array sums = array_of(count, 3, gap, scalar);
      umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
      umb_corner_outputs outputs = UMB_CORNER_OUTPUTS_INIT;
      umb_output single = output_of(&once);
      options.weight = weight;
      outputs.corner = output_of(&corners);
      outputs.normal = output_of(&normals);
      outputs.sum = output_of(&sums);
      outputs.status = bytes_of(status);
      SUCCEEDS(umb_corner_normals(cut, &points, &options, &outputs, &error));
      SUCCEEDS(umb_corner_normals_from_faces(&faces, &points, creases, &options, &single, &error));
      CHECK(memcmp(corners.data, once.data, corners.bytes) == 0);
      for (size_t corner = 0; corner < mesh->index_count; corner++) {
        uint32_t vertex = umb_cut_corners(cut)[corner];
        for (size_t axis = 0; axis < 3; axis++) CHECK(get(&corners, corner, axis) == get(&normals, vertex, axis));
        CHECK(isfinite(length_of(&sums, vertex)));
        CHECK((length_of(&normals, vertex) == 0) == ((status[vertex] & (UMB_VERTEX_DEGENERATE | UMB_VERTEX_ISOLATED)) != 0));
      }
      free(corners.data);
      free(once.data);
      free(normals.data);
      free(sums.data);
    }
    free(status);
    umb_cut_destroy(cut);
  }
}

/* Curvatures stop at creases: a box of flat sides has none. */
static void curvatures(const struct mesh *mesh) {
  umb_error error = UMB_ERROR_INIT;
  umb_cut *cut = cut_of(mesh, NULL, UMB_SCALAR_F64);
  size_t count = umb_cut_vertex_count(cut);
  umb_points points = points_of(mesh, UMB_SCALAR_F64), own;
  struct array positions = array_of(count, 3, 0, UMB_SCALAR_F64), k1 = array_of(count, 1, 0, UMB_SCALAR_F64);
  umb_output output = output_of(&positions);
  umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
  umb_curvature_outputs outputs = UMB_CURVATURE_OUTPUTS_INIT;
  SUCCEEDS(umb_cut_points(cut, &points, &output, &error));
  memset(&own, 0, sizeof own);
  own.data = positions.data;
  own.count = count;
  own.scalar = UMB_SCALAR_F64;
  options.method = UMB_CURVATURE_LEAST_SQUARES;
  outputs.k1 = output_of(&k1);
  SUCCEEDS(umb_curvatures(umb_cut_topology(cut), &own, &options, &outputs, &error));
  for (size_t vertex = 0; vertex < count; vertex++) CHECK(fabs(get(&k1, vertex, 0)) < 1e-9);
  free(positions.data);
  free(k1.data);
  umb_cut_destroy(cut);
}

static void refusals(const struct mesh *mesh) {
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh);
  umb_points points = points_of(mesh, UMB_SCALAR_F64), none = points;
  umb_cut *cut = cut_of(mesh, NULL, UMB_SCALAR_F64), *null = NULL;
  umb_creases creases = UMB_CREASES_INIT;
  uint32_t edges[4] = {0, 1, 2, 8}, groups[5] = {1, 1, 1, 1, 1};
  struct array corners = array_of(mesh->index_count, 3, 0, UMB_SCALAR_F64);
  umb_output output = output_of(&corners), nothing = output;
  umb_corner_outputs outputs = UMB_CORNER_OUTPUTS_INIT;
  umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
  const uint64_t no = UMB_NO_ELEMENT;
  nothing.data = NULL;
  fails(umb_cut_create(NULL, &points, NULL, NULL, &null, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_cut_create(&faces, NULL, NULL, NULL, &null, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_cut_create(&faces, &points, NULL, NULL, NULL, &error), UMB_ERROR_NULL_POINTER, &error, no);
  creases.reserved = 1;
  fails(umb_cut_create(&faces, &points, &creases, NULL, &null, &error), UMB_ERROR_UNKNOWN_FIELD, &error, 4);
  creases.reserved = 0;
  creases.angle = -1;
  fails(umb_cut_create(&faces, &points, &creases, NULL, &null, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
  creases.angle = (double)NAN;
  fails(umb_cut_create(&faces, &points, &creases, NULL, &null, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
  creases.angle = 0;
  creases.edge_count = 2;
  fails(umb_cut_create(&faces, &points, &creases, NULL, &null, &error), UMB_ERROR_NULL_POINTER, &error, no);
  creases.edges = edges;
  fails(umb_cut_create(&faces, &points, &creases, NULL, &null, &error), UMB_ERROR_INDEX_OUT_OF_RANGE, &error, 3);
  creases.edge_count = SIZE_MAX;
  fails(umb_cut_create(&faces, &points, &creases, NULL, &null, &error), UMB_ERROR_SIZE, &error, no);
  creases.edge_count = 1;
  creases.groups = groups;
  creases.group_count = 5;
  fails(umb_cut_create(&faces, &points, &creases, NULL, &null, &error), UMB_ERROR_SIZE, &error, no);
  creases.group_count = 0;
  fails(umb_cut_create(&faces, &points, &creases, NULL, &null, &error), UMB_ERROR_SIZE, &error, no);
  none.count = 7;
  fails(umb_cut_create(&faces, &none, NULL, NULL, &null, &error), UMB_ERROR_INDEX_OUT_OF_RANGE, &error, 6);
  CHECK(null == NULL);

  fails(umb_cut_points(NULL, &points, &output, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_cut_points(cut, &none, &output, &error), UMB_ERROR_SIZE, &error, no);
  fails(umb_cut_points(cut, &points, NULL, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_cut_points(cut, &points, &nothing, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_corner_normals(NULL, &points, NULL, &outputs, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_corner_normals(cut, &points, NULL, NULL, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_corner_normals(cut, &none, NULL, &outputs, &error), UMB_ERROR_SIZE, &error, no);
  outputs.corner = output;
  options.run.vertices = edges;
  options.run.vertex_count = 3;
  fails(umb_corner_normals(cut, &points, &options, &outputs, &error), UMB_ERROR_NOT_APPLICABLE, &error, no);
  fails(umb_corner_normals_from_faces(&faces, &points, NULL, NULL, NULL, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_corner_normals_from_faces(&faces, &points, NULL, &options, &output, &error), UMB_ERROR_NOT_APPLICABLE, &error, no);
  options.run.vertices = NULL;
  options.run.vertex_count = 0;
  mesh->positions[3 * 5] = (double)NAN;
  fails(umb_cut_create(&faces, &points, NULL, NULL, &null, &error), UMB_ERROR_NON_FINITE, &error, 5);
  fails(umb_corner_normals(cut, &points, NULL, &outputs, &error), UMB_ERROR_NON_FINITE, &error, 5);
  for (size_t i = 0; i < corners.bytes; i++) CHECK(corners.data[i] == 0x5a);

  CHECK(umb_cut_topology(NULL) == NULL && umb_cut_corners(NULL) == NULL && umb_cut_origins(NULL) == NULL);
  CHECK(umb_cut_vertex_count(NULL) == 0 && umb_cut_corner_count(NULL) == 0);
  umb_cut_destroy(NULL);
  umb_cut_destroy(cut);
  free(corners.data);
}

int main(void) {
  struct mesh meshes[] = {cube(), sphere(2, 14, 8), torus(12, 9), broken()};
  static const uint32_t edges[6] = {0, 1, 1, 3, 2, 0};
  for (size_t i = 0; i < sizeof meshes / sizeof meshes[0]; i++) {
    umb_creases creases = UMB_CREASES_INIT;
    uint32_t *groups = (uint32_t *)memory(meshes[i].face_count * sizeof *groups);
    for (size_t face = 0; face < meshes[i].face_count; face++) groups[face] = (uint32_t)(face * 7 % 3);
    every_output(&meshes[i], NULL);
    creases.angle = 4;
    creases.edges = edges;
    creases.edge_count = 3;
    every_output(&meshes[i], &creases);
    creases.groups = groups;
    creases.group_count = meshes[i].face_count;
    every_output(&meshes[i], &creases);
    free(groups);
  }
  curvatures(&meshes[0]);
  refusals(&meshes[0]);
  for (size_t i = 0; i < sizeof meshes / sizeof meshes[0]; i++) mesh_free(&meshes[i]);
  puts("corners: split where they should be");
  return 0;
}
