/* Times every curvature method against a plain C scatter kernel, and against CGAL's jets, through the C interface.
 *
 *   make bench                      one thread
 *   make bench BENCH="--subdivide 8 --rounds 21"
 *
 * The reference (common.h) computes area-weighted normals in float and runs before every variant in every round; the
 * ratio printed is the median over rounds of variant to reference in the same round. Times are CPU time of the
 * process; memory is warm. Everything but the reference is in double precision. Methods write k1, k2 and both
 * directions, or what they have of these, H and K. "on given normals" is what a method costs on top of the normals.
 *
 * CGAL::Monge_via_jet_fitting (cgal_jets.cpp) fits the same neighbourhoods of a sample of vertices; gathering these
 * is part of umbilic's time, and not of CGAL's. Every round compares it with umbilic's jets of the same round, which
 * run over all vertices. */
#define _POSIX_C_SOURCE 200809L
#include "common.h"

#ifdef WITH_CGAL
void cgal_jets(const double *points, const double *normals, const uint32_t *members, const size_t *offsets,
               size_t count, unsigned degree, double *k1);
#endif

enum { SAMPLE = 500 };

/* What a variant calls. */
enum { CURVATURES, NORMALS, EDGE_SECTIONS, DIRECTION_SECTIONS };

/* What a method has to give. */
enum { PRINCIPAL = 1, DIRECTIONS = 2, MEAN_AND_GAUSSIAN = 4, GAUSSIAN = 8, TENSOR = PRINCIPAL | DIRECTIONS };

typedef struct variant {
  const char *name;
  int call, given; /* given: on given normals */
  umb_curvature_method method;
  int gives;
  umb_section section;
  uint32_t degree, rings;
} variant;

static const variant VARIANTS[] = {
    {"normals N_CM", NORMALS, 0, 0, 0, UMB_WEIGHT_CONFORMAL, 0, 0},
    {"normals by tilted sections", NORMALS, 0, 0, 0, UMB_WEIGHT_TILTED_SECTIONS, 0, 0},
    {"normals by jets", NORMALS, 0, 0, 0, UMB_WEIGHT_JET, 3, 2},
    {"normals by adaptive jets, 4 rings", NORMALS, 0, 0, 0, UMB_WEIGHT_ADAPTIVE_JET, 0, 4},
    {"edge sections", EDGE_SECTIONS, 0, 0, 0, UMB_SECTION_SYMMETRIC_PARABOLA, 0, 0},
    {"edge sections", EDGE_SECTIONS, 1, 0, 0, UMB_SECTION_SYMMETRIC_PARABOLA, 0, 0},
    {"direction sections, one each", DIRECTION_SECTIONS, 0, 0, 0, 0, 0, 0},
    {"direction sections, one each", DIRECTION_SECTIONS, 1, 0, 0, 0, 0, 0},
    {"tilted sections", CURVATURES, 0, UMB_CURVATURE_TILTED_SECTIONS, TENSOR, 0, 0, 0},
    {"least squares", CURVATURES, 0, UMB_CURVATURE_LEAST_SQUARES, TENSOR, 0, 0, 0},
    {"least squares", CURVATURES, 1, UMB_CURVATURE_LEAST_SQUARES, TENSOR, 0, 0, 0},
    {"least squares, circles", CURVATURES, 1, UMB_CURVATURE_LEAST_SQUARES, TENSOR, UMB_SECTION_CIRCLE, 0, 0},
    {"Taubin", CURVATURES, 0, UMB_CURVATURE_TAUBIN, TENSOR, 0, 0, 0},
    {"Taubin", CURVATURES, 1, UMB_CURVATURE_TAUBIN, TENSOR, 0, 0, 0},
    {"Watanabe", CURVATURES, 0, UMB_CURVATURE_WATANABE, PRINCIPAL | MEAN_AND_GAUSSIAN, 0, 0, 0},
    {"Watanabe", CURVATURES, 1, UMB_CURVATURE_WATANABE, PRINCIPAL | MEAN_AND_GAUSSIAN, 0, 0, 0},
    {"Meyer", CURVATURES, 0, UMB_CURVATURE_MEYER, PRINCIPAL | MEAN_AND_GAUSSIAN, 0, 0, 0},
    {"Meyer", CURVATURES, 1, UMB_CURVATURE_MEYER, PRINCIPAL | MEAN_AND_GAUSSIAN, 0, 0, 0},
    {"angle defect", CURVATURES, 0, UMB_CURVATURE_ANGLE_DEFECT, GAUSSIAN, 0, 0, 0},
    {"Rusinkiewicz", CURVATURES, 0, UMB_CURVATURE_RUSINKIEWICZ, TENSOR, 0, 0, 0},
    {"Rusinkiewicz", CURVATURES, 1, UMB_CURVATURE_RUSINKIEWICZ, TENSOR, 0, 0, 0},
    {"normal cycle", CURVATURES, 0, UMB_CURVATURE_NORMAL_CYCLE, TENSOR, 0, 0, 0},
    {"normal cycle", CURVATURES, 1, UMB_CURVATURE_NORMAL_CYCLE, TENSOR, 0, 0, 0},
    {"normal cycle, 2 rings", CURVATURES, 1, UMB_CURVATURE_NORMAL_CYCLE, TENSOR, 0, 0, 2},
    {"corrected measure", CURVATURES, 0, UMB_CURVATURE_CORRECTED_MEASURE, TENSOR, 0, 0, 0},
    {"corrected measure", CURVATURES, 1, UMB_CURVATURE_CORRECTED_MEASURE, TENSOR, 0, 0, 0},
    {"corrected measure, 2 rings", CURVATURES, 1, UMB_CURVATURE_CORRECTED_MEASURE, TENSOR, 0, 0, 2},
    {"quadric", CURVATURES, 0, UMB_CURVATURE_QUADRIC, TENSOR, 0, 0, 0},
    {"quadric", CURVATURES, 1, UMB_CURVATURE_QUADRIC, TENSOR, 0, 0, 0},
    {"quadric, 2 rings", CURVATURES, 1, UMB_CURVATURE_QUADRIC, TENSOR, 0, 0, 2},
    {"Goldfeather", CURVATURES, 0, UMB_CURVATURE_GOLDFEATHER, TENSOR, 0, 0, 0},
    {"Goldfeather", CURVATURES, 1, UMB_CURVATURE_GOLDFEATHER, TENSOR, 0, 0, 0},
    {"jets 2, 2 rings", CURVATURES, 0, UMB_CURVATURE_JET, TENSOR, 0, 2, 2},
    {"jets 3, 2 rings", CURVATURES, 0, UMB_CURVATURE_JET, TENSOR, 0, 3, 2},
    {"jets 3, 2 rings", CURVATURES, 1, UMB_CURVATURE_JET, TENSOR, 0, 3, 2},
    {"jets 4, 3 rings", CURVATURES, 0, UMB_CURVATURE_JET, TENSOR, 0, 4, 3},
    {"adaptive jets, 3 rings", CURVATURES, 0, UMB_CURVATURE_ADAPTIVE_JET, TENSOR, 0, 0, 3},
    {"adaptive jets, 4 rings", CURVATURES, 0, UMB_CURVATURE_ADAPTIVE_JET, TENSOR, 0, 0, 4},
    {"adaptive jets, rings by the noise (default)", CURVATURES, 0, UMB_CURVATURE_ADAPTIVE_JET, TENSOR, 0, 0, 0},
};
enum { COUNT = sizeof VARIANTS / sizeof VARIANTS[0] };

typedef struct workspace {
  const mesh *m;
  umb_topology *topology;
  float *reference;
  double *normals, *tangents, *vectors[2], *scalars[2], *sections;
  umb_run how;
} workspace;

static umb_output output_to(double *data) {
  return (umb_output){.data = data, .scalar = UMB_SCALAR_F64};
}

static void run(const workspace *w, const variant *v) {
  umb_error error = UMB_ERROR_INIT;
  umb_points points = {.data = w->m->positions_double, .count = w->m->vertex_count, .scalar = UMB_SCALAR_F64};
  umb_points normals = {0};
  if (v->given) normals = (umb_points){.data = w->normals, .count = points.count, .scalar = UMB_SCALAR_F64};
  if (v->call == NORMALS) {
    umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
    umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT;
    options.weight = v->section;
    options.degree = v->degree;
    options.rings = v->rings;
    options.run = w->how;
    outputs.normal = output_to(w->vectors[0]);
    check(umb_vertex_normals(w->topology, &points, &options, &outputs, &error), &error);
  } else if (v->call == CURVATURES) {
    umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
    umb_curvature_outputs outputs = UMB_CURVATURE_OUTPUTS_INIT;
    options.method = v->method;
    options.section = v->section;
    options.degree = v->degree;
    options.rings = v->rings;
    options.normals = normals;
    options.run = w->how;
    if (v->gives & PRINCIPAL) {
      outputs.k1 = output_to(w->scalars[0]);
      outputs.k2 = output_to(w->scalars[1]);
    }
    if (v->gives & DIRECTIONS) {
      outputs.direction1 = output_to(w->vectors[0]);
      outputs.direction2 = output_to(w->vectors[1]);
    }
    if (v->gives & MEAN_AND_GAUSSIAN) outputs.mean = output_to(w->vectors[0]);
    if (v->gives & (MEAN_AND_GAUSSIAN | GAUSSIAN)) outputs.gaussian = output_to(w->vectors[1]);
    check(umb_curvatures(w->topology, &points, &options, &outputs, &error), &error);
  } else {
    umb_section_options options = UMB_SECTION_OPTIONS_INIT;
    umb_section_outputs outputs = UMB_SECTION_OUTPUTS_INIT;
    options.section = v->section;
    options.normals = normals;
    options.run = w->how;
    outputs.curvature = output_to(w->sections);
    if (v->call == EDGE_SECTIONS) {
      check(umb_edge_sections(w->topology, &points, &options, &outputs, &error), &error);
    } else {
      options.directions = (umb_points){.data = w->tangents, .count = points.count, .scalar = UMB_SCALAR_F64};
      check(umb_direction_sections(w->topology, &points, &options, &outputs, &error), &error);
    }
  }
}

/* What was measured of one row, round by round. */
typedef struct row {
  double *time, *ratio;
} row;

static row new_row(int rounds) {
  return (row){allocate((size_t)rounds * sizeof(double)), allocate((size_t)rounds * sizeof(double))};
}

static void print_row(const char *name, row r, int rounds, int decimals) {
  double median = quantile(r.ratio, rounds, 0.5);
  printf("  %-46s %12.1f %12.*f %12.*f %8.*f\n", name, quantile(r.time, rounds, 0.5), decimals, median, decimals,
         quantile(r.ratio, rounds, 0.25), decimals, quantile(r.ratio, rounds, 0.75));
  free(r.time);
  free(r.ratio);
}

static void bench_methods(const workspace *w, const arguments *given) {
  const mesh *m = w->m;
  int rounds = given->rounds, repeats = m->face_count < 400000 ? 10 : 1;
  row rows[COUNT], reference = new_row(rounds);
  for (int v = 0; v < COUNT; v++) rows[v] = new_row(rounds);
  for (int r = -1; r < rounds; r++) { /* the first round warms up */
    double sum = 0;
    for (int v = 0; v < COUNT; v++) {
      double start = seconds();
      for (int i = 0; i < repeats; i++) scatter_area(m, w->reference);
      double middle = seconds();
      run(w, &VARIANTS[v]);
      double end = seconds();
      sum += (middle - start) / repeats;
      if (r < 0) continue;
      rows[v].time[r] = (end - middle) / (double)m->face_count * 1e9;
      rows[v].ratio[r] = (end - middle) * repeats / (middle - start);
    }
    if (r < 0) continue;
    reference.time[r] = sum / COUNT / (double)m->face_count * 1e9;
    reference.ratio[r] = 1;
  }
  printf("  %-46s %12s %12s %21s\n", "", "ns/triangle", "to scatter", "(quartiles)");
  print_row("plain C scatter, area-weighted normals", reference, rounds, 2);
  for (int v = 0; v < COUNT; v++) {
    char name[80];
    snprintf(name, sizeof name, "%s%s", VARIANTS[v].name, VARIANTS[v].given ? ", on given normals" : "");
    print_row(name, rows[v], rounds, 2);
  }
}

#ifdef WITH_CGAL
/* The vertices within some rings of each vertex of the sample, which comes first. Triangles only. */
static void gather(const workspace *w, size_t step, size_t count, unsigned rings, uint32_t **members, size_t *offsets) {
  const uint32_t *starts = umb_topology_ring_offsets(w->topology), *ring = umb_topology_ring_neighbours(w->topology);
  size_t room = 64 * count, used = 0;
  *members = allocate(room * sizeof **members);
  for (size_t k = 0; k < count; k++) {
    size_t first = offsets[k] = used, next = used;
    (*members)[used++] = (uint32_t)(k * step);
    for (unsigned r = 0; r < rings; r++)
      for (size_t last = used; next < last; next++) {
        uint32_t vertex = (*members)[next];
        for (uint32_t entry = starts[vertex]; entry < starts[vertex + 1]; entry++) {
          size_t known = first;
          while (known < used && (*members)[known] != ring[entry]) known++;
          if (known < used) continue;
          if (used == room && !(*members = realloc(*members, (room *= 2) * sizeof **members))) exit(1);
          (*members)[used++] = ring[entry];
        }
      }
  }
  offsets[count] = used;
}

static void bench_cgal(const workspace *w, const arguments *given) {
  /* Adaptive jets are compared with CGAL's of degree 4 over three rings, vertex by vertex: theirs are other numbers. */
  static const variant jets[] = {
      {"2, 2 rings", CURVATURES, 0, UMB_CURVATURE_JET, TENSOR, 0, 2, 2},
      {"3, 2 rings", CURVATURES, 0, UMB_CURVATURE_JET, TENSOR, 0, 3, 2},
      {"4, 3 rings", CURVATURES, 0, UMB_CURVATURE_JET, TENSOR, 0, 4, 3},
      {"4, 3 rings, to adaptive jets, 4 rings", CURVATURES, 0, UMB_CURVATURE_ADAPTIVE_JET, TENSOR, 0, 0, 4},
  };
  const mesh *m = w->m;
  size_t count = m->vertex_count < SAMPLE ? m->vertex_count : SAMPLE, step = m->vertex_count / count;
  int rounds = given->rounds < 7 ? given->rounds : 7;
  printf("  %-46s %12s %12s %21s\n", "", "ns/triangle", "to umbilic", "(quartiles)");
  for (int v = 0; v < 4; v++) {
    int adaptive = jets[v].method == UMB_CURVATURE_ADAPTIVE_JET;
    uint32_t *members;
    size_t *offsets = allocate((count + 1) * sizeof *offsets);
    double *k1 = allocate(count * sizeof *k1), worst = 0, size = 0;
    gather(w, step, count, adaptive ? 3 : jets[v].rings, &members, offsets);
    row r = new_row(rounds);
    for (int round = -1; round < rounds; round++) {
      double start = seconds();
      run(w, &jets[v]);
      double middle = seconds();
      cgal_jets(m->positions_double, w->normals, members, offsets, count, adaptive ? 4 : jets[v].degree, k1);
      double end = seconds();
      if (round < 0) continue;
      /* A vertex's share of the time is that of the triangles that there are for each. */
      double share = (double)m->vertex_count / (double)m->face_count / (double)count;
      r.time[round] = (end - middle) * share * 1e9;
      r.ratio[round] = (end - middle) * share * (double)m->face_count / (middle - start);
    }
    for (size_t k = 0; k < count; k++) {
      worst = fmax(worst, fabs(k1[k] - w->scalars[0][k * step]));
      size = fmax(size, fabs(k1[k]));
    }
    char name[80];
    snprintf(name, sizeof name, "CGAL jets %s (k1 within %.0e)", jets[v].name, worst / size);
    print_row(name, r, rounds, 1);
    free(members);
    free(offsets);
    free(k1);
  }
}
#endif

static void bench(const mesh *m, const arguments *given) {
  workspace w = {.m = m};
  w.how.threads = (uint32_t)given->threads;
  w.how.simd = (umb_simd)given->simd;
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = {.indices = m->triangles, .index_count = 3 * m->face_count, .face_count = m->face_count};
  check(umb_topology_create(&faces, m->vertex_count, NULL, &w.topology, &error), &error);
  size_t scalars = m->vertex_count * sizeof(double);
  w.reference = allocate(3 * scalars);
  w.normals = allocate(3 * scalars);
  w.tangents = allocate(3 * scalars);
  for (int i = 0; i < 2; i++) {
    w.vectors[i] = allocate(3 * scalars);
    w.scalars[i] = allocate(scalars);
  }
  w.sections = allocate(umb_topology_ring_offsets(w.topology)[m->vertex_count] * sizeof(double));
  /* Given normals are the default ones, given directions the principal ones. */
  run(&w, &VARIANTS[0]);
  memcpy(w.normals, w.vectors[0], 3 * scalars);
  run(&w, &VARIANTS[COUNT - 1]);
  memcpy(w.tangents, w.vectors[0], 3 * scalars);

  printf("\n%s: %zu triangles\n", m->name, m->face_count);
  bench_methods(&w, given);
#ifdef WITH_CGAL
  bench_cgal(&w, given);
#else
  printf("  Built without CGAL and Eigen: no comparison with CGAL's jets.\n");
#endif
  umb_topology_destroy(w.topology);
  free(w.reference);
  free(w.normals);
  free(w.tangents);
  for (int i = 0; i < 2; i++) {
    free(w.vectors[i]);
    free(w.scalars[i]);
  }
  free(w.sections);
}

int main(int argc, char **argv) {
  arguments given = {.rounds = 15, .subdivisions = 6, .threads = 1};
  parse(argc, argv, &given);
  printf("\n%s; curvatures, %d thread(s), %d rounds, medians; --simd %d\n", umb_build_info(), given.threads,
         given.rounds, given.simd);
  mesh sphere = bumpy_sphere(given.subdivisions);
  bench(&sphere, &given);
  free_mesh(&sphere);
  mesh torus = irregular_torus(400, 160);
  bench(&torus, &given);
  free_mesh(&torus);
  return 0;
}
