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
#include "common.h"

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
  arguments given = {.rounds = 15, .subdivisions = 8, .threads = 1};
  parse(argc, argv, &given);
  printf("%s; %d thread(s), %d rounds, medians; --simd %d\n", umb_build_info(), given.threads, given.rounds,
         given.simd);
  mesh sphere = bumpy_sphere(given.subdivisions);
  bench(&sphere, given.rounds, (umb_simd)given.simd, given.threads);
  mesh random_order = shuffled(&sphere);
  bench(&random_order, given.rounds, (umb_simd)given.simd, given.threads);
  free_mesh(&random_order);
  free_mesh(&sphere);
  mesh torus = irregular_torus(400, 160);
  bench(&torus, given.rounds, (umb_simd)given.simd, given.threads);
  free_mesh(&torus);
  return 0;
}
