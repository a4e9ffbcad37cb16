/* Times every vertex-normal weight and the topology build against a plain C scatter kernel, through the C interface.
 *
 *   make bench                      all weights, float and double, one thread
 *   make bench BENCH="--subdivide 8 --rounds 21"
 *
 * The reference adds each triangle's cross product to its three vertices and normalises (area weights, no checks, float),
 * compiled with `cc -O3 -march=native`. It runs before every variant in every round, and the ratio printed is the median
 * over rounds of variant to reference in the same round: the two share whatever the machine does meanwhile. Times are
 * CPU time of the process on one thread. Memory is warm but for the topology build, which allocates and frees in
 * every round. Meshes are generated: an icosphere with bumps (every vertex has valence 5 or 6) in the order in which it is
 * made, the same with vertices and faces shuffled, and an irregular torus (valence up to 10 or so, drawn at random). */
#define _POSIX_C_SOURCE 200809L
#include "umbilic.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct mesh {
  const char *name;
  size_t vertex_count, face_count;
  float *positions;
  double *positions_double;
  uint32_t *triangles;
} mesh;

static void *allocate(size_t bytes) {
  void *memory = malloc(bytes);
  if (!memory) {
    fputs("out of memory\n", stderr);
    exit(1);
  }
  return memory;
}

/* ---- the reference ---- */

static void scatter_area(const mesh *m, float *normals) {
  memset(normals, 0, m->vertex_count * 3 * sizeof(float));
  for (size_t f = 0; f < m->face_count; f++) {
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

/* ---- meshes ---- */

static uint64_t random_state = 1;
static double uniform(void) { /* xorshift: the same meshes everywhere */
  random_state ^= random_state << 13;
  random_state ^= random_state >> 7;
  random_state ^= random_state << 17;
  return (double)(random_state >> 11) / 9007199254740992.0;
}

/* The vertex halfway along an edge, made when first asked for; edges are found through a small open-addressed table. */
typedef struct edge_table {
  uint64_t *keys;
  uint32_t *vertices;
  size_t mask;
} edge_table;

static uint32_t midpoint(edge_table *table, double *positions, size_t *vertex_count, uint32_t a, uint32_t b) {
  uint64_t key = a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
  size_t slot = (size_t)((key * 0x9e3779b97f4a7c15u) >> 20) & table->mask;
  while (table->keys[slot] != UINT64_MAX) {
    if (table->keys[slot] == key) return table->vertices[slot];
    slot = (slot + 1) & table->mask;
  }
  double *p = positions + 3 * *vertex_count, length = 0;
  for (int i = 0; i < 3; i++) {
    p[i] = positions[3 * (size_t)a + (size_t)i] + positions[3 * (size_t)b + (size_t)i];
    length += p[i] * p[i];
  }
  for (int i = 0; i < 3; i++) p[i] /= sqrt(length);
  table->keys[slot] = key;
  return table->vertices[slot] = (uint32_t)(*vertex_count)++;
}

static void finish_mesh(mesh *m) {
  m->positions = allocate(m->vertex_count * 3 * sizeof(float));
  for (size_t i = 0; i < 3 * m->vertex_count; i++) m->positions[i] = (float)m->positions_double[i];
}

static mesh bumpy_sphere(int subdivisions) {
  static const uint32_t icosahedron[60] = {0, 11, 5, 0, 5,  1,  0,  1,  7,  0,  7, 10, 0, 10, 11, 1, 5, 9, 5, 11,
                                           4, 11, 10, 2, 10, 7, 6,  7,  1,  8,  3, 9,  4, 3,  4,  2, 3, 2, 6, 3,
                                           6, 8,  3,  8, 9,  4, 9,  5,  2,  4,  11, 6, 2, 10, 8,  6, 7, 9, 8, 1};
  const double g = (1 + sqrt(5.0)) / 2, l = sqrt(1 + g * g);
  const double corners[36] = {-1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, 0, 0, -1, g, 0, 1, g,
                              0, -1, -g, 0, 1, -g, g, 0, -1, g, 0, 1, -g, 0, -1, -g, 0, 1};
  mesh m = {.name = "bumpy sphere"};
  size_t faces = 20;
  for (int s = 0; s < subdivisions; s++) faces *= 4;
  m.positions_double = allocate((faces / 2 + 2) * 3 * sizeof(double));
  m.triangles = allocate(faces * 3 * sizeof(uint32_t));
  uint32_t *coarse = allocate(faces * 3 * sizeof(uint32_t));
  for (int i = 0; i < 36; i++) m.positions_double[i] = corners[i] / l;
  memcpy(m.triangles, icosahedron, sizeof icosahedron);
  m.vertex_count = 12;
  m.face_count = 20;
  for (int s = 0; s < subdivisions; s++) {
    size_t size = 1;
    while (size < 4 * m.face_count) size *= 2;
    edge_table table = {allocate(size * sizeof(uint64_t)), allocate(size * sizeof(uint32_t)), size - 1};
    memset(table.keys, 0xff, size * sizeof(uint64_t));
    memcpy(coarse, m.triangles, m.face_count * 3 * sizeof(uint32_t));
    for (size_t f = 0; f < m.face_count; f++) {
      uint32_t a = coarse[3 * f], b = coarse[3 * f + 1], c = coarse[3 * f + 2];
      uint32_t ab = midpoint(&table, m.positions_double, &m.vertex_count, a, b);
      uint32_t bc = midpoint(&table, m.positions_double, &m.vertex_count, b, c);
      uint32_t ca = midpoint(&table, m.positions_double, &m.vertex_count, c, a);
      const uint32_t fine[12] = {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca};
      memcpy(m.triangles + 12 * f, fine, sizeof fine);
    }
    m.face_count *= 4;
    free(table.keys);
    free(table.vertices);
  }
  free(coarse);
  for (size_t v = 0; v < m.vertex_count; v++) {
    double *p = m.positions_double + 3 * v;
    double radius = 1 + 0.08 * sin(5 * p[0]) * sin(4 * p[1] + 1) * sin(6 * p[2]);
    for (int i = 0; i < 3; i++) p[i] *= radius;
  }
  finish_mesh(&m);
  return m;
}

static mesh shuffled(const mesh *m) {
  mesh s = {"the same, shuffled", m->vertex_count, m->face_count, NULL, NULL, NULL};
  s.positions_double = allocate(m->vertex_count * 3 * sizeof(double));
  s.triangles = allocate(m->face_count * 3 * sizeof(uint32_t));
  uint32_t *place = allocate(m->vertex_count * sizeof(uint32_t));
  for (size_t v = 0; v < m->vertex_count; v++) {
    size_t other = (size_t)(uniform() * (double)(v + 1));
    place[v] = place[other];
    place[other] = (uint32_t)v;
  }
  for (size_t v = 0; v < m->vertex_count; v++)
    memcpy(s.positions_double + 3 * (size_t)place[v], m->positions_double + 3 * v, 3 * sizeof(double));
  for (size_t f = 0; f < m->face_count; f++) {
    size_t other = (size_t)(uniform() * (double)(f + 1));
    memcpy(s.triangles + 3 * f, s.triangles + 3 * other, 3 * sizeof(uint32_t));
    for (int i = 0; i < 3; i++) s.triangles[3 * other + (size_t)i] = place[m->triangles[3 * f + (size_t)i]];
  }
  free(place);
  finish_mesh(&s);
  return s;
}

/* A grid on the torus with jittered parameters, and each quad cut along a diagonal drawn at random. */
static mesh irregular_torus(size_t columns, size_t rows) {
  mesh m = {"irregular torus", columns * rows, 2 * columns * rows, NULL, NULL, NULL};
  m.positions_double = allocate(m.vertex_count * 3 * sizeof(double));
  m.triangles = allocate(m.face_count * 3 * sizeof(uint32_t));
  const double turn = 2 * acos(-1.0);
  for (size_t i = 0; i < columns; i++)
    for (size_t j = 0; j < rows; j++) {
      double u = turn * ((double)i + 0.44 * (uniform() - 0.5)) / (double)columns;
      double v = turn * ((double)j + 0.44 * (uniform() - 0.5)) / (double)rows;
      double *p = m.positions_double + 3 * (i * rows + j);
      p[0] = (1 + 0.4 * cos(v)) * cos(u);
      p[1] = (1 + 0.4 * cos(v)) * sin(u);
      p[2] = 0.4 * sin(v);
      uint32_t a = (uint32_t)(i * rows + j), d = (uint32_t)(i * rows + (j + 1) % rows);
      uint32_t b = (uint32_t)((i + 1) % columns * rows + j), c = (uint32_t)((i + 1) % columns * rows + (j + 1) % rows);
      uint32_t *t = m.triangles + 6 * (i * rows + j);
      if (uniform() < 0.5) {
        const uint32_t cut[6] = {a, b, c, a, c, d};
        memcpy(t, cut, sizeof cut);
      } else {
        const uint32_t cut[6] = {a, b, d, b, c, d};
        memcpy(t, cut, sizeof cut);
      }
    }
  finish_mesh(&m);
  return m;
}

static void free_mesh(mesh *m) {
  free(m->positions);
  free(m->positions_double);
  free(m->triangles);
}

/* ---- timing ---- */

static double seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int ascending(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double quantile(double *values, int count, double q) {
  qsort(values, (size_t)count, sizeof *values, ascending);
  return values[(int)(q * (count - 1) + 0.5)];
}

static void check(umb_status status, const umb_error *error) {
  if (status == UMB_OK) return;
  fprintf(stderr, "%s: %s\n", umb_status_string(status), error->message);
  exit(1);
}

typedef struct variant {
  const char *name;
  umb_weight weight;
  umb_scalar scalar;
  int kind; /* 0: sweep over a topology, 1: straight from faces, 2: topology build */
} variant;

typedef struct workspace {
  const mesh *m;
  umb_topology *topology;
  float *normals;
  double *normals_double;
  umb_simd simd;
  int threads;
} workspace;

static void run(const workspace *w, const variant *v) {
  const mesh *m = w->m;
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = {.indices = m->triangles, .index_count = 3 * m->face_count, .face_count = m->face_count};
  if (v->kind == 2) {
    umb_topology *built = NULL;
    check(umb_topology_create(&faces, m->vertex_count, NULL, &built, &error), &error);
    umb_topology_destroy(built);
    return;
  }
  umb_points points = {.count = m->vertex_count, .scalar = v->scalar};
  umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
  umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT;
  int wide = v->scalar == UMB_SCALAR_F64;
  points.data = wide ? (const void *)m->positions_double : m->positions;
  options.weight = v->weight;
  options.run.threads = (uint32_t)w->threads;
  options.run.simd = w->simd;
  outputs.normal.data = wide ? (void *)w->normals_double : w->normals;
  outputs.normal.scalar = v->scalar;
  if (v->kind == 0)
    check(umb_vertex_normals(w->topology, &points, &options, &outputs, &error), &error);
  else
    check(umb_vertex_normals_from_faces(&faces, &points, &options, &outputs, &error), &error);
}

static void bench(const mesh *m, int rounds, umb_simd simd, int threads) {
  static const char *const names[10] = {"conformal (N_CM)", "uniform",  "angle",           "area", "max",
                                        "centroid-area",    "centroid", "inverse-root-edges", "sine", "angle-edges"};
  variant variants[32];
  int count = 0;
  variants[count++] = (variant){"topology build", 0, 0, 2};
  for (umb_weight w = 0; w < 10; w++) variants[count++] = (variant){names[w], w, UMB_SCALAR_F32, 0};
  variants[count++] = (variant){"conformal, from faces", UMB_WEIGHT_CONFORMAL, UMB_SCALAR_F32, 1};

  for (umb_weight w = 0; w < 10; w++) variants[count++] = (variant){names[w], w, UMB_SCALAR_F64, 0};

  workspace w = {m, NULL, allocate(m->vertex_count * 12), allocate(m->vertex_count * 24), simd, threads};
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = {.indices = m->triangles, .index_count = 3 * m->face_count, .face_count = m->face_count};
  check(umb_topology_create(&faces, m->vertex_count, NULL, &w.topology, &error), &error);
  umb_topology_stats stats = UMB_TOPOLOGY_STATS_INIT;
  check(umb_topology_get_stats(w.topology, &stats, &error), &error);

  double *reference = allocate((size_t)rounds * sizeof(double)), *all = allocate((size_t)rounds * 32 * sizeof(double));
  double *time = allocate((size_t)rounds * sizeof(double)), *ratio = allocate((size_t)rounds * sizeof(double));
  double *ratios = allocate((size_t)rounds * 32 * sizeof(double));
  int repeats = m->face_count < 400000 ? 5 : 1;
  double reference_sum = 0;
  for (int r = -1; r < rounds; r++) /* the first round warms up */
    for (int v = 0; v < count; v++) {
      double start = seconds();
      for (int i = 0; i < repeats; i++) scatter_area(m, w.normals);
      double middle = seconds();
      for (int i = 0; i < repeats; i++) run(&w, &variants[v]);
      double end = seconds();
      if (r < 0) continue;
      all[v * rounds + r] = (end - middle) / repeats / (double)m->face_count * 1e9;
      ratios[v * rounds + r] = (end - middle) / (middle - start);
      reference[r] = (middle - start) / repeats / (double)m->face_count * 1e9;
      reference_sum += reference[r];
    }
  printf("\n%s: %zu triangles, valence up to %llu; the handle holds %.1f bytes a triangle\n", m->name, m->face_count,
         (unsigned long long)stats.max_valence, (double)stats.bytes / (double)m->face_count);
  printf("  %-28s %12s %18s %22s\n", "", "ns/triangle", "ratio to scatter", "(quartiles)");
  printf("  %-28s %12.2f %18s\n", "plain C scatter, area", reference_sum / rounds / count, "1");
  for (int v = 0; v < count; v++) {
    char label[64];
    snprintf(label, sizeof label, "%s%s", variants[v].name,
             variants[v].kind == 2 ? "" : variants[v].scalar == UMB_SCALAR_F64 ? ", double" : ", float");
    memcpy(time, all + v * rounds, (size_t)rounds * sizeof(double));
    memcpy(ratio, ratios + v * rounds, (size_t)rounds * sizeof(double));
    double median = quantile(ratio, rounds, 0.5);
    printf("  %-28s %12.2f %18.2f %14.2f %7.2f\n", label, quantile(time, rounds, 0.5), median,
           quantile(ratio, rounds, 0.25), quantile(ratio, rounds, 0.75));
  }
  umb_topology_destroy(w.topology);
  free(reference);
  free(all);
  free(time);
  free(ratio);
  free(ratios);
  free(w.normals);
  free(w.normals_double);
}

int main(int argc, char **argv) {
  int rounds = 15, subdivisions = 8, threads = 1, simd = 0;
  for (int i = 1; i + 1 < argc; i += 2) {
    int value = atoi(argv[i + 1]);
    if (!strcmp(argv[i], "--rounds") && value > 0) rounds = value;
    else if (!strcmp(argv[i], "--subdivide") && value >= 0) subdivisions = value;
    else if (!strcmp(argv[i], "--threads") && value >= 0) threads = value;
    else if (!strcmp(argv[i], "--simd") && value >= 0) simd = value;
    else {
      fprintf(stderr, "usage: %s [--rounds N] [--subdivide N] [--threads N] [--simd 0..4]\n", argv[0]);
      return 2;
    }
  }
  printf("%s; %d thread(s), %d rounds, medians; --simd %d\n", umb_build_info(), threads, rounds, simd);
  mesh sphere = bumpy_sphere(subdivisions);
  bench(&sphere, rounds, (umb_simd)simd, threads);
  mesh random_order = shuffled(&sphere);
  bench(&random_order, rounds, (umb_simd)simd, threads);
  free_mesh(&random_order);
  free_mesh(&sphere);
  mesh torus = irregular_torus(400, 160);
  bench(&torus, rounds, (umb_simd)simd, threads);
  free_mesh(&torus);
  return 0;
}
