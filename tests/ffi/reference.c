/*
 * What the programs of bindings/ are compared with: reads an OFF file, and writes normals, statuses and curvatures as raw memory.
 *
 *   reference MESH RESULTS
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <umbilic.h>

struct mesh {
  size_t vertex_count, face_count, index_count;
  double *positions;
  uint32_t *indices, *offsets;
};

static void *need(void *memory) {
  if (memory == NULL) {
    fprintf(stderr, "out of memory\n");
    exit(EXIT_FAILURE);
  }
  return memory;
}

static void *array(size_t count, size_t size) { return need(malloc(count * size + 1)); }

/* The next number of the file; comments run to the end of their line. */
static char *word(FILE *file) {
  static char text[64];
  while (fscanf(file, " %63[^# \t\r\n]", text) != 1) {
    if (getc(file) != '#') {
      fprintf(stderr, "the file ends early\n");
      exit(EXIT_FAILURE);
    }
    for (int c = 0; c != '\n' && c != EOF;) c = getc(file);
  }
  return text;
}

static void skip_line(FILE *file) {
  for (int c = 0; c != '\n' && c != EOF;) c = getc(file);
}

static struct mesh read_off(const char *path) {
  FILE *file = fopen(path, "r");
  if (file == NULL) {
    perror(path);
    exit(EXIT_FAILURE);
  }
  struct mesh mesh = {0};
  word(file); /* OFF */
  mesh.vertex_count = strtoul(word(file), NULL, 10);
  mesh.face_count = strtoul(word(file), NULL, 10);
  word(file); /* edges */
  mesh.positions = array(mesh.vertex_count, 3 * sizeof(double));
  mesh.offsets = array(mesh.face_count + 1, sizeof(uint32_t));
  mesh.indices = array(0, sizeof(uint32_t));
  for (size_t v = 0; v < mesh.vertex_count; v++) {
    for (size_t axis = 0; axis < 3; axis++) mesh.positions[3 * v + axis] = strtod(word(file), NULL);
    skip_line(file); /* colours, here and below */
  }
  mesh.offsets[0] = 0;
  for (size_t f = 0; f < mesh.face_count; f++) {
    size_t corners = strtoul(word(file), NULL, 10);
    mesh.indices = need(realloc(mesh.indices, (mesh.index_count + corners) * sizeof(uint32_t) + 1));
    for (size_t i = 0; i < corners; i++) mesh.indices[mesh.index_count++] = (uint32_t)strtoul(word(file), NULL, 10);
    mesh.offsets[f + 1] = (uint32_t)mesh.index_count;
    skip_line(file);
  }
  fclose(file);
  return mesh;
}

static void check(umb_status status, const umb_error *error) {
  if (status != UMB_OK) {
    fprintf(stderr, "umbilic: %s (status %d)\n", error->message, (int)status);
    exit(EXIT_FAILURE);
  }
}

static umb_output output(double *data) { return (umb_output){.data = data, .scalar = UMB_SCALAR_F64}; }

static void put(FILE *file, const void *data, size_t size, size_t count) {
  if (fwrite(data, size, count, file) != count) {
    perror("results");
    exit(EXIT_FAILURE);
  }
}

int main(int count, char **arguments) {
  if (count != 3) {
    fprintf(stderr, "usage: reference MESH RESULTS\n");
    return 2;
  }
  struct mesh mesh = read_off(arguments[1]);
  size_t vertices = mesh.vertex_count;
  umb_faces faces = {.indices = mesh.indices,
                     .index_count = mesh.index_count,
                     .offsets = mesh.offsets,
                     .face_count = mesh.face_count,
                     .index = UMB_INDEX_U32};
  umb_error error = UMB_ERROR_INIT;
  umb_topology *topology;
  check(umb_topology_create(&faces, vertices, NULL, &topology, &error), &error);

  umb_points points = {.data = mesh.positions, .count = vertices, .scalar = UMB_SCALAR_F64};
  uint8_t *status = array(vertices, 1);
  double *normal = array(vertices, 3 * sizeof(double));
  umb_normal_outputs normals = UMB_NORMAL_OUTPUTS_INIT;
  normals.normal = output(normal);
  normals.status.data = status;
  check(umb_vertex_normals(topology, &points, NULL, &normals, &error), &error);

  FILE *file = fopen(arguments[2], "wb");
  if (file == NULL) {
    perror(arguments[2]);
    return EXIT_FAILURE;
  }
  put(file, normal, 3 * sizeof(double), vertices);
  put(file, status, 1, vertices);

  /* k1, k2, direction1, direction2, mean, gaussian. */
  static const size_t scalars[] = {1, 1, 3, 3, 1, 1};
  double *found[6];
  for (int i = 0; i < 6; i++) found[i] = array(vertices, scalars[i] * sizeof(double));
  umb_curvature_outputs curvatures = UMB_CURVATURE_OUTPUTS_INIT;
  curvatures.k1 = output(found[0]);
  curvatures.k2 = output(found[1]);
  curvatures.direction1 = output(found[2]);
  curvatures.direction2 = output(found[3]);
  curvatures.mean = output(found[4]);
  curvatures.gaussian = output(found[5]);
  curvatures.status.data = status;
  check(umb_curvatures(topology, &points, NULL, &curvatures, &error), &error);
  for (int i = 0; i < 6; i++) put(file, found[i], scalars[i] * sizeof(double), vertices);
  put(file, status, 1, vertices);
  if (fclose(file) != 0) {
    perror(arguments[2]);
    return EXIT_FAILURE;
  }

  umb_topology_destroy(topology);
  for (int i = 0; i < 6; i++) free(found[i]);
  free(normal);
  free(status);
  free(mesh.positions);
  free(mesh.indices);
  free(mesh.offsets);
  return EXIT_SUCCESS;
}
