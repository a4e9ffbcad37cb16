/*
 * Meshes that move: over a sphere of 100,000 vertices travels a dent, then vertices here and there shake. After each frame only what has
 * changed is computed anew. The topology is built once, for the faces stay the same.
 *
 * Build and run, in this directory, after `cargo build --release` in the one above:
 *
 *   ln -sf libumbilic.so ../target/release/libumbilic.so.0
 *   cc -std=c99 -O2 -Wall -Wextra -I../include moving.c -o moving \
 *     -L../target/release -lumbilic -lm -Wl,-rpath,../target/release
 *   ./moving
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <umbilic.h>

static const double PI = 3.14159265358979323846;

enum {
  AROUND = 400, /* vertices in a ring */
  RINGS = 250,  /* and rings from pole to pole, the poles aside */
  VERTEX_COUNT = AROUND * RINGS + 2,
  FACE_COUNT = AROUND * RINGS * 2,
  FRAMES = 60
};

/* What a renderer takes, interleaved. */
struct vertex {
  float position[3];
  float normal[3];
};

struct results {
  struct vertex *vertices;
  float *k1, *k2;
  uint8_t *status; /* of the curvatures */
};

static void *room(size_t count, size_t size) {
  void *memory = calloc(count, size);
  if (!memory) {
    fputs("No memory.\n", stderr);
    exit(EXIT_FAILURE);
  }
  return memory;
}

/* Every call reports what went wrong through a status, and in words through the error. */
static void check(umb_status status, const umb_error *error) {
  if (status != UMB_OK) {
    fprintf(stderr, "umbilic: %s: %s\n", umb_status_string(status), error->message);
    exit(EXIT_FAILURE);
  }
}

/* A point of the unit sphere; the last two are the poles. */
static void on_sphere(uint32_t vertex, double *point) {
  if (vertex >= AROUND * RINGS) {
    point[0] = point[1] = 0;
    point[2] = vertex == AROUND * RINGS ? 1 : -1;
    return;
  }
  double polar = PI * (vertex / AROUND + 1) / (RINGS + 1), around = 2 * PI * (vertex % AROUND) / AROUND;
  point[0] = sin(polar) * cos(around);
  point[1] = sin(polar) * sin(around);
  point[2] = cos(polar);
}

static void fill(uint32_t *corner) {
  const uint32_t north = AROUND * RINGS, south = north + 1;
  for (uint32_t i = 0; i < AROUND; i++) {
    uint32_t next = (i + 1) % AROUND, last = AROUND * (RINGS - 1);
    *corner++ = north, *corner++ = i, *corner++ = next;
    *corner++ = south, *corner++ = last + next, *corner++ = last + i;
    for (uint32_t ring = 0; ring + 1 < RINGS; ring++) {
      uint32_t a = ring * AROUND + i, b = a + AROUND, c = (ring + 1) * AROUND + next, d = ring * AROUND + next;
      *corner++ = a, *corner++ = b, *corner++ = c;
      *corner++ = a, *corner++ = c, *corner++ = d;
    }
  }
}

/* Where the dent is in a frame. */
static void centre_of(int frame, double *centre) {
  double along = 2 * PI * frame / FRAMES;
  centre[0] = cos(along);
  centre[1] = sin(along) * cos(0.5);
  centre[2] = sin(along) * sin(0.5);
}

/* Puts every vertex where a frame has it; lists those that have moved, and answers with their number. */
typedef size_t motion(struct vertex *vertices, int frame, uint32_t *moved);

static size_t dent(struct vertex *vertices, int frame, uint32_t *moved) {
  double centre[3], point[3];
  size_t count = 0;
  centre_of(frame, centre);
  for (uint32_t v = 0; v < VERTEX_COUNT; v++) {
    on_sphere(v, point);
    double cosine = point[0] * centre[0] + point[1] * centre[1] + point[2] * centre[2];
    double near = cosine > 0.99 ? (cosine - 0.99) / 0.01 : 0, radius = 1 - 0.05 * near * near * near;
    float place[3] = {(float)(radius * point[0]), (float)(radius * point[1]), (float)(radius * point[2])};
    if (memcmp(place, vertices[v].position, sizeof place) != 0) {
      memcpy(vertices[v].position, place, sizeof place);
      moved[count++] = v;
    }
  }
  return count;
}

/* Each frame moves one vertex in a hundred, wherever it is. */
static size_t shake(struct vertex *vertices, int frame, uint32_t *moved) {
  double point[3];
  size_t count = 0;
  for (uint32_t v = (uint32_t)(frame * 37 % 100); v < VERTEX_COUNT; v += 100) {
    on_sphere(v, point);
    for (int axis = 0; axis < 3; axis++)
      vertices[v].position[axis] = (float)(point[axis] * (1 + 0.001 * (frame % 3 - 1)));
    moved[count++] = v;
  }
  return count;
}

/* Normals (N_CM) and principal curvatures (least squares over N_CM), of all vertices or of those in the lists. */
static void compute(const umb_topology *mesh, struct results *to, const umb_run *normals, const umb_run *curvatures) {
  umb_error error = UMB_ERROR_INIT;
  umb_points points = {.data = to->vertices, .count = VERTEX_COUNT, .stride = sizeof(struct vertex)};
  umb_normal_options normal_options = UMB_NORMAL_OPTIONS_INIT;
  umb_normal_outputs normal_outputs = UMB_NORMAL_OUTPUTS_INIT;
  umb_curvature_options curvature_options = UMB_CURVATURE_OPTIONS_INIT;
  umb_curvature_outputs curvature_outputs = UMB_CURVATURE_OUTPUTS_INIT;
  normal_options.run = *normals;
  normal_outputs.normal.data = to->vertices[0].normal;
  normal_outputs.normal.stride = sizeof(struct vertex);
  curvature_options.method = UMB_CURVATURE_LEAST_SQUARES;
  curvature_options.run = *curvatures;
  curvature_outputs.k1.data = to->k1;
  curvature_outputs.k2.data = to->k2;
  curvature_outputs.status.data = to->status;
  check(umb_vertex_normals(mesh, &points, &normal_options, &normal_outputs, &error), &error);
  check(umb_curvatures(mesh, &points, &curvature_options, &curvature_outputs, &error), &error);
}

static struct results results_new(void) {
  struct results results = {room(VERTEX_COUNT, sizeof(struct vertex)), room(VERTEX_COUNT, sizeof(float)),
                            room(VERTEX_COUNT, sizeof(float)), room(VERTEX_COUNT, 1)};
  return results;
}

static int same(const struct results *a, const struct results *b) {
  return memcmp(a->vertices, b->vertices, VERTEX_COUNT * sizeof *a->vertices) == 0 &&
         memcmp(a->k1, b->k1, VERTEX_COUNT * sizeof *a->k1) == 0 &&
         memcmp(a->k2, b->k2, VERTEX_COUNT * sizeof *a->k2) == 0;
}

static double seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }

/* Prints frames a second; answers with whether no bit differed. */
static int animate(const umb_topology *mesh, const char *title, motion *move) {
  umb_error error = UMB_ERROR_INIT;
  uint32_t *moved_list = room(VERTEX_COUNT, sizeof *moved_list), *normal_list = room(VERTEX_COUNT, sizeof *normal_list);
  uint32_t *curvature_list = room(VERTEX_COUNT, sizeof *curvature_list);
  struct results full = results_new(), partial = results_new();
  umb_run whole = {.threads = 1};
  double full_seconds = 0, partial_seconds = 0, moved_part = 0, affected_part = 0;
  int differing = 0;

  dent(full.vertices, 0, moved_list);
  dent(partial.vertices, 0, moved_list);
  compute(mesh, &full, &whole, &whole);
  compute(mesh, &partial, &whole, &whole);
  for (int frame = 1; frame <= FRAMES; frame++) {
    umb_moved moved = UMB_MOVED_INIT;
    umb_curvature_options curvature_options = UMB_CURVATURE_OPTIONS_INIT;
    umb_run normals = whole, curvatures = whole;
    move(full.vertices, frame, moved_list);
    moved.vertex_count = move(partial.vertices, frame, moved_list);
    moved.vertices = moved_list;
    curvature_options.method = UMB_CURVATURE_LEAST_SQUARES;

    double start = seconds();
    compute(mesh, &full, &whole, &whole);
    double between = seconds();
    check(umb_affected_normals(mesh, &moved, NULL, normal_list, VERTEX_COUNT, &normals.vertex_count, &error),
          &error);
    check(umb_affected_curvatures(mesh, &moved, &curvature_options, curvature_list, VERTEX_COUNT,
                                  &curvatures.vertex_count, &error),
          &error);
    normals.vertices = normal_list;
    curvatures.vertices = curvature_list;
    compute(mesh, &partial, &normals, &curvatures);
    partial_seconds += seconds() - between;
    full_seconds += between - start;
    moved_part += (double)moved.vertex_count / VERTEX_COUNT / FRAMES;
    affected_part += (double)curvatures.vertex_count / VERTEX_COUNT / FRAMES;
    differing += !same(&full, &partial);
  }

  printf("%s: %.2f %% of %d vertices move in a frame, %.2f %% are affected. Normals and curvatures, one thread:\n", title,
         100 * moved_part, VERTEX_COUNT, 100 * affected_part);
  printf("  of all vertices      %7.0f frames a second\n", FRAMES / full_seconds);
  printf("  of those affected    %7.0f frames a second: %.2f %% of the time\n", FRAMES / partial_seconds,
         100 * partial_seconds / full_seconds);
  printf("  frames whose bits differ: %d\n", differing);
  free(full.vertices), free(full.k1), free(full.k2), free(full.status);
  free(partial.vertices), free(partial.k1), free(partial.k2), free(partial.status);
  free(moved_list), free(normal_list), free(curvature_list);
  return differing == 0;
}

int main(void) {
  umb_error error = UMB_ERROR_INIT;
  umb_topology *mesh = NULL;
  uint32_t *indices = room(3 * FACE_COUNT, sizeof *indices);
  fill(indices);
  umb_faces faces = {.indices = indices, .index_count = 3 * FACE_COUNT};
  check(umb_topology_create(&faces, VERTEX_COUNT, NULL, &mesh, &error), &error);
  int good = animate(mesh, "A dent travels", dent) & animate(mesh, "Vertices shake", shake);
  umb_topology_destroy(mesh);
  free(indices);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
