/*
 * A first program with umbilic: normals of a torus, from plain arrays, compared with the true ones.
 *
 * Build and run, in this directory, after `cargo build --release` in the one above:
 *
 *   ln -sf libumbilic.so ../target/release/libumbilic.so.0
 *   cc -std=c99 -O2 -Wall -Wextra -I../include normals.c -o normals \
 *     -L../target/release -lumbilic -lm -Wl,-rpath,../target/release
 *   ./normals
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <umbilic.h>

static const double PI = 3.14159265358979323846;

enum {
  AROUND = 96, /* vertices the long way round */
  ACROSS = 40, /* and the short way */
  VERTEX_COUNT = AROUND * ACROSS,
  INDEX_COUNT = VERTEX_COUNT * 2 * 3 /* two triangles a vertex, three corners a triangle */
};

/* A vertex as graphics programs keep it: umbilic reads the position and writes the normal where they are. */
struct vertex {
  float position[3];
  float normal[3];
  float uv[2];
};

struct torus {
  struct vertex vertices[VERTEX_COUNT];
  double positions[VERTEX_COUNT][3]; /* the same, before rounding to float */
  double true_normals[VERTEX_COUNT][3];
  uint32_t indices[INDEX_COUNT];
};

static const struct {
  umb_weight weight;
  const char *name;
  double largest; /* error to expect, in degrees */
} WEIGHTS[] = {
    {UMB_WEIGHT_CONFORMAL, "conformal (N_CM)", 0.7},
    {UMB_WEIGHT_MAX, "Max", 0.9},
    {UMB_WEIGHT_CENTROID, "centroid", 3.1},
    {UMB_WEIGHT_ANGLE, "angle", 1.2},
    {UMB_WEIGHT_UNIFORM, "uniform", 1.6},
    {UMB_WEIGHT_AREA, "area", 2.5},
};

/* Every call reports what went wrong through a status, and in words through the error. */
static void check(umb_status status, const umb_error *error) {
  if (status != UMB_OK) {
    fprintf(stderr, "umbilic: %s: %s\n", umb_status_string(status), error->message);
    exit(EXIT_FAILURE);
  }
}

/* A number from -1 to 1, the same sequence everywhere. */
static double jitter(void) {
  static uint32_t state = 1;
  state = state * 1664525u + 1013904223u;
  return (double)(state >> 8) / (double)(1u << 23) - 1.0;
}

/* A torus of radii 1 and 0.4 whose vertices are moved about on the surface, so that no ring is regular. */
static void fill(struct torus *torus) {
  for (uint32_t v = 0; v < VERTEX_COUNT; v++) {
    uint32_t i = v / ACROSS, j = v % ACROSS;
    double u = (i + 0.15 * jitter()) / AROUND, w = (j + 0.15 * jitter()) / ACROSS;
    double long_way = 2.0 * PI * u, short_way = 2.0 * PI * w;
    double *normal = torus->true_normals[v], *position = torus->positions[v];
    normal[0] = cos(long_way) * cos(short_way);
    normal[1] = sin(long_way) * cos(short_way);
    normal[2] = sin(short_way);
    position[0] = cos(long_way) + 0.4 * normal[0];
    position[1] = sin(long_way) + 0.4 * normal[1];
    position[2] = 0.4 * normal[2];
    for (int axis = 0; axis < 3; axis++) {
      torus->vertices[v].position[axis] = (float)position[axis];
    }
    torus->vertices[v].uv[0] = (float)u;
    torus->vertices[v].uv[1] = (float)w;

    /* The quad from here to the next vertex both ways, as two triangles, counter-clockwise seen from outside. */
    uint32_t next_i = (i + 1) % AROUND, next_j = (j + 1) % ACROSS;
    uint32_t a = v, b = next_i * ACROSS + j, c = next_i * ACROSS + next_j, d = i * ACROSS + next_j;
    uint32_t *corner = &torus->indices[6 * v];
    corner[0] = a, corner[1] = b, corner[2] = c;
    corner[3] = a, corner[4] = c, corner[5] = d;
  }
}

static double degrees_between(const double a[3], const double b[3]) {
  double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
  double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  return atan2(sqrt(x * x + y * y + z * z), dot) * 180.0 / PI;
}

/* Normals in single precision, inside the vertex buffer: the stride leads from one vertex to the next. */
static void float_normals(const umb_topology *topology, struct torus *torus, umb_weight weight) {
  umb_error error = UMB_ERROR_INIT;
  umb_points points = {0};
  points.data = torus->vertices[0].position;
  points.count = VERTEX_COUNT;
  points.stride = sizeof(struct vertex);
  points.scalar = UMB_SCALAR_F32;

  umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
  options.weight = weight;
  umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT;
  outputs.normal.data = torus->vertices[0].normal;
  outputs.normal.stride = sizeof(struct vertex);
  outputs.normal.scalar = UMB_SCALAR_F32;
  check(umb_vertex_normals(topology, &points, &options, &outputs, &error), &error);
}

/* Normals in double precision, from packed arrays to packed arrays; of the `chosen` vertices, or of all if null. */
static void double_normals(const umb_topology *topology, const struct torus *torus, umb_weight weight,
                           const uint32_t *chosen, size_t chosen_count, double normals[][3]) {
  umb_error error = UMB_ERROR_INIT;
  umb_points points = {0};
  points.data = torus->positions;
  points.count = VERTEX_COUNT;
  points.scalar = UMB_SCALAR_F64;

  umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
  options.weight = weight;
  options.run.vertices = chosen;
  options.run.vertex_count = chosen_count;
  umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT;
  outputs.normal.data = normals;
  outputs.normal.scalar = UMB_SCALAR_F64;
  check(umb_vertex_normals(topology, &points, &options, &outputs, &error), &error);
}

/* One line of the table; the answer is the largest error of either precision. */
static double compare(const char *name, const struct torus *torus, const double normals[][3]) {
  double sum[2] = {0.0, 0.0}, worst[2] = {0.0, 0.0};
  for (int v = 0; v < VERTEX_COUNT; v++) {
    const float *single = torus->vertices[v].normal;
    const double widened[3] = {single[0], single[1], single[2]};
    const double error[2] = {degrees_between(widened, torus->true_normals[v]),
                             degrees_between(normals[v], torus->true_normals[v])};
    for (int precision = 0; precision < 2; precision++) {
      sum[precision] += error[precision];
      worst[precision] = fmax(worst[precision], error[precision]);
    }
  }
  printf("%-18s %10.5f %10.5f %12.5f %10.5f\n", name, sum[0] / VERTEX_COUNT, worst[0], sum[1] / VERTEX_COUNT, worst[1]);
  return fmax(worst[0], worst[1]);
}

/* A vertex index that does not exist is refused, and the error tells where it stands. */
static int refuses_bad_index(struct torus *torus, umb_faces faces) {
  enum { PLACE = 1234 };
  uint32_t good = torus->indices[PLACE];
  torus->indices[PLACE] = VERTEX_COUNT;
  umb_error error = UMB_ERROR_INIT;
  umb_topology *topology = NULL;
  umb_status status = umb_topology_create(&faces, VERTEX_COUNT, NULL, &topology, &error);
  torus->indices[PLACE] = good;

  printf("\nA bad index, on purpose:\n");
  printf("  status  %d (%s)\n", (int)status, umb_status_string(status));
  printf("  element %llu\n", (unsigned long long)error.element);
  printf("  message %s\n", error.message);
  umb_topology_destroy(topology); /* still null: outputs are written only on success */
  return status == UMB_ERROR_INDEX_OUT_OF_RANGE && error.element == PLACE;
}

/* A few vertices alone have the bits that they have among all; every other element of the output is left alone. */
static int subset_agrees(const umb_topology *topology, const struct torus *torus, double all[][3], double some[][3]) {
  const uint32_t chosen[] = {7, 0, VERTEX_COUNT - 1};
  const size_t chosen_count = sizeof chosen / sizeof chosen[0];
  double_normals(topology, torus, UMB_WEIGHT_CONFORMAL, NULL, 0, all);
  memset(some, 0, VERTEX_COUNT * sizeof some[0]);
  double_normals(topology, torus, UMB_WEIGHT_CONFORMAL, chosen, chosen_count, some);

  int same = 1;
  printf("\nThree vertices alone:\n");
  for (size_t k = 0; k < chosen_count; k++) {
    const double *normal = some[chosen[k]];
    same = same && memcmp(normal, all[chosen[k]], sizeof some[0]) == 0;
    printf("  vertex %4u: %9.6f %9.6f %9.6f\n", (unsigned)chosen[k], normal[0], normal[1], normal[2]);
  }
  const double untouched[3] = {0.0, 0.0, 0.0};
  return same && memcmp(some[1], untouched, sizeof untouched) == 0;
}

int main(void) {
  if (umb_abi_version() != UMB_ABI_VERSION) {
    fprintf(stderr, "this program and the library do not fit together\n");
    return EXIT_FAILURE;
  }
  struct torus *torus = malloc(sizeof *torus);
  double(*normals)[3] = malloc(VERTEX_COUNT * sizeof *normals);
  double(*some)[3] = malloc(VERTEX_COUNT * sizeof *some);
  if (torus == NULL || normals == NULL || some == NULL) {
    fprintf(stderr, "out of memory\n");
    return EXIT_FAILURE;
  }
  fill(torus);

  /* The topology is built once, and serves as long as the faces stay; positions may move. */
  umb_faces faces = {0};
  faces.indices = torus->indices;
  faces.index_count = INDEX_COUNT;
  faces.index = UMB_INDEX_U32;
  umb_error error = UMB_ERROR_INIT;
  umb_topology *topology = NULL;
  check(umb_topology_create(&faces, VERTEX_COUNT, NULL, &topology, &error), &error);

  printf("%s\n\nAngle to the true normal of a torus of %d vertices, in degrees\n\n", umb_build_info(), VERTEX_COUNT);
  printf("%-18s %21s %23s\n", "", "single precision", "double precision");
  printf("%-18s %10s %10s %12s %10s\n", "weight", "mean", "max", "mean", "max");
  int good = 1;
  for (size_t k = 0; k < sizeof WEIGHTS / sizeof WEIGHTS[0]; k++) {
    float_normals(topology, torus, WEIGHTS[k].weight);
    double_normals(topology, torus, WEIGHTS[k].weight, NULL, 0, normals);
    good = compare(WEIGHTS[k].name, torus, (const double(*)[3])normals) <= WEIGHTS[k].largest && good;
  }
  good = subset_agrees(topology, torus, normals, some) && good;
  good = refuses_bad_index(torus, faces) && good;

  umb_topology_destroy(topology);
  free(some);
  free(normals);
  free(torus);
  printf("\n%s\n", good ? "All as expected." : "NOT as expected.");
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
