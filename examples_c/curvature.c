/*
 * A first program with umbilic's curvatures: those of a torus and of a circle, compared with the true ones.
 *
 * Build and run, in this directory, after `cargo build --release` in the one above:
 *
 *   ln -sf libumbilic.so ../target/release/libumbilic.so.0
 *   cc -std=c99 -O2 -Wall -Wextra -I../include curvature.c -o curvature \
 *     -L../target/release -lumbilic -lm -Wl,-rpath,../target/release
 *   ./curvature
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <umbilic.h>

static const double PI = 3.14159265358979323846;
static const double RADIUS = 0.4; /* of the torus's tube; that of its centre line is 1 */

enum {
  AROUND = 160, /* vertices the long way round */
  ACROSS = 64, /* and the short way */
  VERTEX_COUNT = AROUND * ACROSS,
  INDEX_COUNT = VERTEX_COUNT * 2 * 3, /* two triangles a vertex, three corners a triangle */
  CIRCLE_COUNT = 50
};

/* What a program may keep at a vertex: every output has a stride, so umbilic writes results where they belong. */
struct curvature {
  double k1, k2;
  double direction1[3], direction2[3];
  double mean, gaussian;
};

struct torus {
  double positions[VERTEX_COUNT][3];
  double normals[VERTEX_COUNT][3];
  struct curvature truth[VERTEX_COUNT]; /* direction 1 is the short way round, direction 2 the long way */
  struct curvature found[VERTEX_COUNT];
  uint32_t indices[INDEX_COUNT];
};

enum { PRINCIPAL = 1, DIRECTIONS = 2, MEAN = 4, GAUSSIAN = 8, ALL = 15 };

/* What each method has to give (see umb_curvature_method), and its mean error of k1 or, if it has none, of H or K to
   expect on this mesh. Edges of the mesh are about 0.04 long. */
static const struct {
  const char *name;
  umb_curvature_method method;
  uint32_t degree; /* of jets; 0 for the default, 3 */
  int gives;
  double largest;
} METHODS[] = {
    {"adaptive jets (default)", UMB_CURVATURE_ADAPTIVE_JET, 0, ALL, 0.03},
    {"jets of degree 3", UMB_CURVATURE_JET, 0, ALL, 0.03},
    {"jets of degree 4", UMB_CURVATURE_JET, 4, ALL, 0.002},
    {"tilted sections", UMB_CURVATURE_TILTED_SECTIONS, 0, ALL, 0.06},
    {"quadric", UMB_CURVATURE_QUADRIC, 0, ALL, 0.08},
    {"Goldfeather", UMB_CURVATURE_GOLDFEATHER, 0, ALL, 0.06},
    {"Rusinkiewicz", UMB_CURVATURE_RUSINKIEWICZ, 0, ALL, 0.045},
    {"least squares", UMB_CURVATURE_LEAST_SQUARES, 0, ALL, 0.06},
    {"Taubin", UMB_CURVATURE_TAUBIN, 0, ALL, 0.7},
    {"Watanabe", UMB_CURVATURE_WATANABE, 0, PRINCIPAL | MEAN | GAUSSIAN, 0.35},
    {"Meyer", UMB_CURVATURE_MEYER, 0, PRINCIPAL | MEAN | GAUSSIAN, 0.2},
    {"angle defect", UMB_CURVATURE_ANGLE_DEFECT, 0, GAUSSIAN, 0.25},
    {"normal cycle", UMB_CURVATURE_NORMAL_CYCLE, 0, ALL, 0.2},
    {"corrected measure", UMB_CURVATURE_CORRECTED_MEASURE, 0, ALL, 0.045},
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

/* A torus whose vertices are moved about on the surface, so that no ring is regular. */
static void fill(struct torus *torus) {
  for (uint32_t v = 0; v < VERTEX_COUNT; v++) {
    uint32_t i = v / ACROSS, j = v % ACROSS;
    double u = 2.0 * PI * (i + 0.25 * jitter()) / AROUND, w = 2.0 * PI * (j + 0.25 * jitter()) / ACROSS;
    double *normal = torus->normals[v], *position = torus->positions[v];
    normal[0] = cos(u) * cos(w);
    normal[1] = sin(u) * cos(w);
    normal[2] = sin(w);
    position[0] = cos(u) + RADIUS * normal[0];
    position[1] = sin(u) + RADIUS * normal[1];
    position[2] = RADIUS * normal[2];

    /* Positive where the surface bends away from its normals, which point outwards. */
    struct curvature *truth = &torus->truth[v];
    truth->k1 = 1.0 / RADIUS;
    truth->k2 = cos(w) / (1.0 + RADIUS * cos(w));
    truth->direction1[0] = -cos(u) * sin(w);
    truth->direction1[1] = -sin(u) * sin(w);
    truth->direction1[2] = cos(w);
    truth->direction2[0] = -sin(u);
    truth->direction2[1] = cos(u);
    truth->direction2[2] = 0.0;
    truth->mean = (truth->k1 + truth->k2) / 2.0;
    truth->gaussian = truth->k1 * truth->k2;

    /* The quad from here to the next vertex both ways, as two triangles, counter-clockwise seen from outside. */
    uint32_t next_i = (i + 1) % AROUND, next_j = (j + 1) % ACROSS;
    uint32_t a = v, b = next_i * ACROSS + j, c = next_i * ACROSS + next_j, d = i * ACROSS + next_j;
    uint32_t *corner = &torus->indices[6 * v];
    corner[0] = a, corner[1] = b, corner[2] = c;
    corner[3] = a, corner[4] = c, corner[5] = d;
  }
}

/* A packed array of one vector a vertex, given by the first. */
static umb_points points_of(const double *first) {
  umb_points array = {0};
  array.data = first;
  array.count = VERTEX_COUNT;
  array.scalar = UMB_SCALAR_F64;
  return array;
}

/* An output into one field of an array of curvatures. */
static umb_output output_to(double *field) {
  umb_output output = {0};
  output.data = field;
  output.stride = sizeof(struct curvature);
  output.scalar = UMB_SCALAR_F64;
  return output;
}

/* Curvatures of the torus, as the options say, into `found`; outputs that a method does not have stay null. */
static umb_status compute(const umb_topology *topology, const struct torus *torus, const umb_curvature_options *options,
                          int gives, struct curvature *found, umb_error *error) {
  umb_points points = points_of(torus->positions[0]);
  umb_curvature_outputs outputs = UMB_CURVATURE_OUTPUTS_INIT;
  if (gives & PRINCIPAL) {
    outputs.k1 = output_to(&found->k1);
    outputs.k2 = output_to(&found->k2);
  }
  if (gives & DIRECTIONS) {
    outputs.direction1 = output_to(found->direction1);
    outputs.direction2 = output_to(found->direction2);
  }
  if (gives & MEAN) outputs.mean = output_to(&found->mean);
  if (gives & GAUSSIAN) outputs.gaussian = output_to(&found->gaussian);
  return umb_curvatures(topology, &points, options, &outputs, error);
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Between two directions, which are the same as their opposites. */
static double degrees_between(const double a[3], const double b[3]) {
  double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
  return atan2(sqrt(x * x + y * y + z * z), fabs(dot(a, b))) * 180.0 / PI;
}

static void print_mean(double sum, int given) {
  if (given) {
    printf(" %10.5f", sum / VERTEX_COUNT);
  } else {
    printf(" %10s", "-");
  }
}

/* One line of the table. */
static double compare(const char *name, const struct torus *torus, int gives) {
  double k1 = 0.0, k2 = 0.0, mean = 0.0, gaussian = 0.0, degrees = 0.0;
  for (int v = 0; v < VERTEX_COUNT; v++) {
    const struct curvature *found = &torus->found[v], *truth = &torus->truth[v];
    k1 += fabs(found->k1 - truth->k1);
    k2 += fabs(found->k2 - truth->k2);
    mean += fabs(found->mean - truth->mean);
    gaussian += fabs(found->gaussian - truth->gaussian);
    degrees += degrees_between(found->direction1, truth->direction1);
  }
  printf("%-28s", name);
  print_mean(k1, gives & PRINCIPAL);
  print_mean(k2, gives & PRINCIPAL);
  print_mean(mean, gives & MEAN);
  print_mean(gaussian, gives & GAUSSIAN);
  print_mean(degrees, gives & DIRECTIONS);
  printf("\n");
  return (gives & PRINCIPAL ? k1 : gives & MEAN ? mean : gaussian) / VERTEX_COUNT;
}

static int all_methods(const umb_topology *topology, struct torus *torus) {
  printf("Mean error on a torus of %d vertices; 1/radius of its tube is %g\n\n", VERTEX_COUNT, 1.0 / RADIUS);
  printf("%-28s %10s %10s %10s %10s %10s\n", "method", "k1", "k2", "H", "K", "degrees");
  int good = 1;
  umb_error error = UMB_ERROR_INIT;
  umb_curvature_options options;
  for (size_t k = 0; k < sizeof METHODS / sizeof METHODS[0]; k++) {
    options = (umb_curvature_options)UMB_CURVATURE_OPTIONS_INIT;
    options.method = METHODS[k].method;
    options.degree = METHODS[k].degree;
    check(compute(topology, torus, &options, METHODS[k].gives, torus->found, &error), &error);
    good = compare(METHODS[k].name, torus, METHODS[k].gives) <= METHODS[k].largest && good;
  }

  /* With normals of one's own, here the true ones. What limits most methods is the normals. */
  options = (umb_curvature_options)UMB_CURVATURE_OPTIONS_INIT;
  options.method = UMB_CURVATURE_CORRECTED_MEASURE;
  options.normals = points_of(torus->normals[0]);
  check(compute(topology, torus, &options, ALL, torus->found, &error), &error);
  good = compare("corrected, true normals", torus, ALL) <= 0.01 && good;

  /* Or with better normals of the library's. */
  options = (umb_curvature_options)UMB_CURVATURE_OPTIONS_INIT;
  options.method = UMB_CURVATURE_CORRECTED_MEASURE;
  options.weight = UMB_WEIGHT_JET;
  check(compute(topology, torus, &options, ALL, torus->found, &error), &error);
  return compare("corrected, normals of jets", torus, ALL) <= 0.01 && good;
}

/* The angle defects of a closed mesh add up to 2 pi times its Euler characteristic, that of a torus is 0. */
static int gauss_bonnet(const umb_topology *topology, const struct torus *torus, double *integrals) {
  umb_points points = points_of(torus->positions[0]);
  umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
  options.method = UMB_CURVATURE_ANGLE_DEFECT;
  umb_curvature_outputs outputs = UMB_CURVATURE_OUTPUTS_INIT;
  outputs.integrated_gaussian.data = integrals;
  outputs.integrated_gaussian.scalar = UMB_SCALAR_F64;
  umb_error error = UMB_ERROR_INIT;
  check(umb_curvatures(topology, &points, &options, &outputs, &error), &error);
  umb_topology_stats stats = UMB_TOPOLOGY_STATS_INIT;
  check(umb_topology_get_stats(topology, &stats, &error), &error);

  double sum = 0.0, expected = 2.0 * PI * (double)stats.euler_characteristic;
  for (int v = 0; v < VERTEX_COUNT; v++) {
    sum += integrals[v];
  }
  printf("\nGauss-Bonnet: all angle defects together are %.1e, 2 pi chi is %g\n", sum, expected);
  return fabs(sum - expected) < 1e-10;
}

/* A few vertices alone have the bits that they have among all; every other element of the output is left alone. */
static int subset_agrees(const umb_topology *topology, struct torus *torus) {
  static const uint32_t chosen[] = {7, 0, VERTEX_COUNT - 1};
  umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
  umb_error error = UMB_ERROR_INIT;
  check(compute(topology, torus, &options, ALL, torus->found, &error), &error);
  struct curvature all[3];
  for (int k = 0; k < 3; k++) {
    all[k] = torus->found[chosen[k]];
  }
  memset(torus->found, 0, sizeof torus->found);
  options.run.vertices = chosen;
  options.run.vertex_count = 3;
  check(compute(topology, torus, &options, ALL, torus->found, &error), &error);

  int same = torus->found[1].k1 == 0.0;
  printf("\nThree vertices alone:\n");
  for (int k = 0; k < 3; k++) {
    const struct curvature *found = &torus->found[chosen[k]];
    same = same && memcmp(found, &all[k], sizeof all[k]) == 0;
    printf("  vertex %4u: k1 %8.5f of %g, k2 %8.5f of %8.5f\n", (unsigned)chosen[k], found->k1, 1.0 / RADIUS, found->k2,
           torus->truth[chosen[k]].k2);
  }
  return same;
}

/* One curvature along each edge, held against Euler's theorem: k1 cos^2 + k2 sin^2. The ring array says where each edge
   leads. */
static int edge_sections(const umb_topology *topology, const struct torus *torus) {
  const uint32_t *offsets = umb_topology_ring_offsets(topology);
  const uint32_t *neighbours = umb_topology_ring_neighbours(topology);
  double *sections = malloc(offsets[VERTEX_COUNT] * sizeof *sections);
  if (sections == NULL) return 0;

  umb_points points = points_of(torus->positions[0]);
  umb_section_options options = UMB_SECTION_OPTIONS_INIT;
  options.section = UMB_SECTION_CIRCLE;
  options.normals = points_of(torus->normals[0]);
  umb_section_outputs outputs = UMB_SECTION_OUTPUTS_INIT;
  outputs.curvature.data = sections;
  outputs.curvature.scalar = UMB_SCALAR_F64;
  umb_error error = UMB_ERROR_INIT;
  check(umb_edge_sections(topology, &points, &options, &outputs, &error), &error);

  double sum = 0.0;
  for (uint32_t v = 0; v < VERTEX_COUNT; v++) {
    const struct curvature *truth = &torus->truth[v];
    for (uint32_t entry = offsets[v]; entry < offsets[v + 1]; entry++) {
      double edge[3];
      for (int axis = 0; axis < 3; axis++) {
        edge[axis] = torus->positions[neighbours[entry]][axis] - torus->positions[v][axis];
      }
      double along1 = dot(edge, truth->direction1), along2 = dot(edge, truth->direction2);
      double expected = truth->k1 * along1 * along1 + truth->k2 * along2 * along2;
      sum += fabs(sections[entry] - expected / (along1 * along1 + along2 * along2));
    }
  }
  double mean = sum / offsets[VERTEX_COUNT];
  printf("\nSections along all %u half-edges, circles with true normals: off by %.5f in the mean\n",
         (unsigned)offsets[VERTEX_COUNT], mean);
  free(sections);
  return mean < 0.05;
}

/* The section in one direction of each vertex: the short way round, where the torus is a circle. It meets the ring
   between two neighbours, where the mesh lies below the surface, so these curvatures are too large by a part that no
   finer mesh takes away. */
static int direction_section(const umb_topology *topology, const struct torus *torus, double *sections) {
  umb_points points = points_of(torus->positions[0]);
  umb_section_options options = UMB_SECTION_OPTIONS_INIT;
  options.directions = points_of(torus->truth[0].direction1); /* read inside the structs, like any other array */
  options.directions.stride = sizeof(struct curvature);
  umb_section_outputs outputs = UMB_SECTION_OUTPUTS_INIT;
  outputs.curvature.data = sections;
  outputs.curvature.scalar = UMB_SCALAR_F64;
  umb_error error = UMB_ERROR_INIT;
  check(umb_direction_sections(topology, &points, &options, &outputs, &error), &error);

  double sum = 0.0;
  for (int v = 0; v < VERTEX_COUNT; v++) {
    sum += fabs(sections[v] - 1.0 / RADIUS);
  }
  printf("Sections across the tube, parabolas with the default normals: off by %.5f in the mean\n", sum / VERTEX_COUNT);
  return sum / VERTEX_COUNT < 0.35;
}

/* A circle of radius 2 through points that are not evenly spaced. */
static int circle(void) {
  double points[CIRCLE_COUNT][2], by_circle[CIRCLE_COUNT], by_parabola[CIRCLE_COUNT];
  for (int p = 0; p < CIRCLE_COUNT; p++) {
    double angle = 2.0 * PI * (p + 0.3 * jitter()) / CIRCLE_COUNT;
    points[p][0] = 2.0 * cos(angle);
    points[p][1] = 2.0 * sin(angle);
  }
  umb_polyline polyline = {0};
  polyline.data = points;
  polyline.count = CIRCLE_COUNT;
  polyline.scalar = UMB_SCALAR_F64;
  polyline.dimension = 2;
  polyline.closed = 1;
  umb_polyline_outputs outputs = UMB_POLYLINE_OUTPUTS_INIT;
  outputs.circle.data = by_circle;
  outputs.circle.scalar = UMB_SCALAR_F64;
  outputs.symmetric_parabola.data = by_parabola;
  outputs.symmetric_parabola.scalar = UMB_SCALAR_F64;
  umb_error error = UMB_ERROR_INIT;
  check(umb_polyline_curvatures(&polyline, NULL, &outputs, &error), &error);

  double circle_error = 0.0, parabola_error = 0.0;
  for (int p = 0; p < CIRCLE_COUNT; p++) {
    circle_error = fmax(circle_error, fabs(by_circle[p] - 0.5));
    parabola_error = fmax(parabola_error, fabs(by_parabola[p] - 0.5));
  }
  printf("\nA circle of radius 2 as a polyline: kappa_C off by %.1e at most, kappa_SP by %.5f\n", circle_error,
         parabola_error);
  return circle_error < 1e-14 && parabola_error < 0.01;
}

/* Watanabe's method has no directions, and a call that asks for them says so and writes nothing. */
static int refuses_what_it_does_not_have(const umb_topology *topology, struct torus *torus) {
  memset(torus->found, 0, sizeof torus->found);
  umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
  options.method = UMB_CURVATURE_WATANABE;
  umb_error error = UMB_ERROR_INIT;
  umb_status status = compute(topology, torus, &options, ALL, torus->found, &error);
  printf("\nDirections by a method that has none, on purpose:\n");
  printf("  status  %d (%s)\n", (int)status, umb_status_string(status));
  printf("  message %s\n", error.message);
  return status == UMB_ERROR_NOT_APPLICABLE && torus->found[0].k1 == 0.0;
}

int main(void) {
  if (umb_abi_version() != UMB_ABI_VERSION) {
    fprintf(stderr, "this program and the library do not fit together\n");
    return EXIT_FAILURE;
  }
  struct torus *torus = calloc(1, sizeof *torus);
  double *scalars = malloc(VERTEX_COUNT * sizeof *scalars);
  if (torus == NULL || scalars == NULL) {
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

  printf("%s\n\n", umb_build_info());
  int good = all_methods(topology, torus);
  good = gauss_bonnet(topology, torus, scalars) && good;
  good = subset_agrees(topology, torus) && good;
  good = edge_sections(topology, torus) && good;
  good = direction_section(topology, torus, scalars) && good;
  good = circle() && good;
  good = refuses_what_it_does_not_have(topology, torus) && good;

  umb_topology_destroy(topology);
  free(scalars);
  free(torus);
  printf("\n%s\n", good ? "All as expected." : "NOT as expected.");
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
