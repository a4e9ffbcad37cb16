/* Meshes for the C programs of this folder, made here so that no file is needed. */
#ifndef MESH_H
#define MESH_H

#include "check.h"
#include "umbilic.h"

static const double PI = 3.14159265358979323846;

struct mesh {
  size_t vertex_count, face_count, index_count;
  double *positions; /* vertex_count x 3 */
  float *rounded;    /* the same, in single precision */
  uint32_t *indices;
  uint32_t *offsets; /* face_count + 1; NULL if all faces are triangles */
};

static inline struct mesh mesh_of(size_t vertex_count, size_t face_count, size_t index_count, int polygons) {
  struct mesh mesh;
  mesh.vertex_count = vertex_count;
  mesh.face_count = face_count;
  mesh.index_count = index_count;
  mesh.positions = (double *)memory(vertex_count * 3 * sizeof(double));
  mesh.rounded = (float *)memory(vertex_count * 3 * sizeof(float));
  mesh.indices = (uint32_t *)memory(index_count * sizeof(uint32_t));
  mesh.offsets = polygons ? (uint32_t *)memory((face_count + 1) * sizeof(uint32_t)) : NULL;
  return mesh;
}

static inline void mesh_free(struct mesh *mesh) {
  free(mesh->positions);
  free(mesh->rounded);
  free(mesh->indices);
  free(mesh->offsets);
}

static inline void mesh_place(struct mesh *mesh, size_t vertex, double x, double y, double z) {
  const double position[3] = {x, y, z};
  for (size_t i = 0; i < 3; i++) {
    mesh->positions[3 * vertex + i] = position[i];
    mesh->rounded[3 * vertex + i] = (float)position[i];
  }
}

/* A closed sphere of triangles about the origin: `across - 1` rings of `around` vertices, and two poles. */
static inline struct mesh sphere(double radius, uint32_t around, uint32_t across) {
  uint32_t south = (across - 1) * around, north = south + 1;
  struct mesh mesh = mesh_of(north + 1, 2 * south, 6 * (size_t)south, 0);
  uint32_t *index = mesh.indices;
  for (uint32_t i = 0; i + 1 < across; i++) {
    double down = PI * (i + 1) / across;
    for (uint32_t j = 0; j < around; j++) {
      /* Rings are turned against each other, so that the mesh is nowhere a grid. */
      double turn = 2 * PI * (j + 0.5 * i) / around;
      uint32_t here = i * around + j, next = i * around + (j + 1) % around;
      mesh_place(&mesh, here, radius * sin(down) * cos(turn), radius * sin(down) * sin(turn), radius * cos(down));
      if (i == 0) {
        *index++ = north, *index++ = here, *index++ = next;
      } else {
        uint32_t above = here - around, above_next = next - around;
        *index++ = above, *index++ = here, *index++ = above_next;
        *index++ = above_next, *index++ = here, *index++ = next;
      }
      if (i + 2 == across) *index++ = next, *index++ = here, *index++ = south;
    }
  }
  mesh_place(&mesh, north, 0, 0, radius);
  mesh_place(&mesh, south, 0, 0, -radius);
  CHECK(index == mesh.indices + mesh.index_count);
  return mesh;
}

/* A torus of radii 1 and 0.4, of quads of which every third is cut in two. */
static inline struct mesh torus(uint32_t around, uint32_t across) {
  uint32_t quads = around * across, cut = (quads + 2) / 3;
  struct mesh mesh = mesh_of(quads, quads + cut, 4 * (size_t)quads + 2 * (size_t)cut, 1);
  uint32_t *index = mesh.indices, *offset = mesh.offsets;
  *offset++ = 0;
  for (uint32_t v = 0; v < quads; v++) {
    uint32_t i = v / across, j = v % across;
    double u = 2 * PI * i / around, w = 2 * PI * j / across, distance = 1 + 0.4 * cos(w);
    uint32_t right = (i + 1) % around * across + j, up = i * across + (j + 1) % across;
    uint32_t beyond = (i + 1) % around * across + (j + 1) % across;
    mesh_place(&mesh, v, distance * cos(u), distance * sin(u), 0.4 * sin(w));
    *index++ = v, *index++ = right, *index++ = beyond;
    if (v % 3 == 0) {
      *offset = offset[-1] + 3, offset++;
      *index++ = v, *index++ = beyond, *index++ = up;
      *offset = offset[-1] + 3, offset++;
    } else {
      *index++ = up;
      *offset = offset[-1] + 4, offset++;
    }
  }
  CHECK(index == mesh.indices + mesh.index_count && offset == mesh.offsets + mesh.face_count + 1);
  return mesh;
}

/* The unit cube, of quads. */
static inline struct mesh cube(void) {
  static const uint32_t corners[24] = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  struct mesh mesh = mesh_of(8, 6, 24, 1);
  for (uint32_t v = 0; v < 8; v++) mesh_place(&mesh, v, v & 1, v >> 1 & 1, v >> 2);
  memcpy(mesh.indices, corners, sizeof corners);
  for (uint32_t f = 0; f <= 6; f++) mesh.offsets[f] = 4 * f;
  return mesh;
}

/* What real files hold: an open sheet with a fin on an inner edge, a face twice, one that repeats a corner, one of a
   single point, and a vertex that nothing uses. */
static inline struct mesh broken(void) {
  enum { SIDE = 9, CELLS = (SIDE - 1) * (SIDE - 1), MORE = 4 };
  struct mesh mesh = mesh_of(SIDE * SIDE + 2, 2 * CELLS + MORE, 3 * (2 * CELLS + MORE), 0);
  uint32_t fin = SIDE * SIDE, *index = mesh.indices;
  for (uint32_t i = 0; i < SIDE; i++) {
    for (uint32_t j = 0; j < SIDE; j++) {
      uint32_t v = i * SIDE + j;
      double x = i / 4.0 - 1, y = j / 4.0 - 1;
      mesh_place(&mesh, v, x, y, 0.3 * x * x - 0.2 * x * y + 0.1 * y * y);
      if (i + 1 < SIDE && j + 1 < SIDE) {
        *index++ = v, *index++ = v + SIDE, *index++ = v + 1;
        *index++ = v + 1, *index++ = v + SIDE, *index++ = v + SIDE + 1;
      }
    }
  }
  mesh_place(&mesh, fin, 0, 0, 1);
  mesh_place(&mesh, fin + 1, 3, 3, 3);
  *index++ = 40, *index++ = 41, *index++ = fin;
  *index++ = 0, *index++ = SIDE, *index++ = 1;
  *index++ = 20, *index++ = 20, *index++ = 21;
  *index++ = 7, *index++ = 7, *index++ = 7;
  CHECK(index == mesh.indices + mesh.index_count);
  return mesh;
}

static inline umb_faces faces_of(const struct mesh *mesh) {
  umb_faces faces = {0};
  faces.indices = mesh->indices;
  faces.index_count = mesh->index_count;
  faces.offsets = mesh->offsets;
  faces.face_count = mesh->face_count;
  return faces;
}

static inline umb_points points_of(const struct mesh *mesh, umb_scalar scalar) {
  umb_points points = {0};
  points.data = scalar == UMB_SCALAR_F64 ? (const void *)mesh->positions : (const void *)mesh->rounded;
  points.count = mesh->vertex_count;
  points.scalar = scalar;
  return points;
}

static inline umb_topology *topology_of(const struct mesh *mesh, uint32_t threads) {
  umb_faces faces = faces_of(mesh);
  umb_topology_options options = UMB_TOPOLOGY_OPTIONS_INIT;
  umb_error error = UMB_ERROR_INIT;
  umb_topology *topology = NULL;
  options.threads = threads;
  SUCCEEDS(umb_topology_create(&faces, mesh->vertex_count, &options, &topology, &error));
  return topology;
}

/* A call that must fail like this, and say so. */
static inline void fails(umb_status found, umb_status expected, const umb_error *error, uint64_t element) {
  if (found != expected || error->status != expected || error->element != element || error->message[0] == '\0') {
    fprintf(stderr, "status %d instead of %d, element %llu: %s\n", (int)found, (int)expected,
            (unsigned long long)error->element, error->message);
    exit(EXIT_FAILURE);
  }
}

/* An array for a call to write: `components` scalars for each of `count` elements, `gap` scalars between elements and
   none after the last, so that a byte too many is beyond the block. */
struct array {
  unsigned char *data;
  size_t count, components, stride, bytes;
  umb_scalar scalar;
};

static inline size_t scalar_size(umb_scalar scalar) {
  return scalar == UMB_SCALAR_F64 ? sizeof(double) : sizeof(float);
}

static inline struct array array_of(size_t count, size_t components, size_t gap, umb_scalar scalar) {
  struct array array;
  array.count = count;
  array.components = components;
  array.stride = (components + gap) * scalar_size(scalar);
  array.bytes = count == 0 ? 0 : (count - 1) * array.stride + components * scalar_size(scalar);
  array.scalar = scalar;
  array.data = (unsigned char *)memory(array.bytes);
  return array;
}

static inline umb_output output_of(const struct array *array) {
  umb_output output = {0};
  output.data = array->data;
  output.stride = array->stride;
  output.scalar = array->scalar;
  return output;
}

static inline umb_status_output bytes_of(unsigned char *data) {
  umb_status_output output = {0};
  output.data = data;
  return output;
}

static inline double get(const struct array *array, size_t element, size_t component) {
  const unsigned char *at = array->data + element * array->stride + component * scalar_size(array->scalar);
  double wide;
  float narrow;
  if (array->scalar == UMB_SCALAR_F64) {
    memcpy(&wide, at, sizeof wide);
    return wide;
  }
  memcpy(&narrow, at, sizeof narrow);
  return (double)narrow;
}

static inline double length_of(const struct array *array, size_t element) {
  double sum = 0;
  for (size_t i = 0; i < 3; i++) sum += get(array, element, i) * get(array, element, i);
  return sqrt(sum);
}

#endif
