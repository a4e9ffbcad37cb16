#include "ours.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a variant calls. */
enum { TOPOLOGY, NORMALS, FROM_FACES, CUT, CORNERS, INDEXED_CORNERS, CURVATURES, EDGE_SECTIONS, DIRECTION_SECTIONS };

/* What a method has to give. */
enum { PRINCIPAL = 1, DIRECTIONS = 2, MEAN_AND_GAUSSIAN = 4, GAUSSIAN = 8, TENSOR = PRINCIPAL | DIRECTIONS };

typedef struct variant {
  const char *name;
  int call;
  umb_curvature_method method;
  int gives;
  uint32_t kind; /* the weight of normals, the section of all else */
  uint32_t degree, rings;
} variant;

/* A name that ends with "on given normals" is that of the variant without these words. */
static const char GIVEN[] = ", on given normals";

static const variant VARIANTS[] = {
    {"topology", TOPOLOGY, 0, 0, 0, 0, 0},
    {"N_CM from faces", FROM_FACES, 0, 0, UMB_WEIGHT_CONFORMAL, 0, 0},
    {"N_CM", NORMALS, 0, 0, UMB_WEIGHT_CONFORMAL, 0, 0},
    {"uniform", NORMALS, 0, 0, UMB_WEIGHT_UNIFORM, 0, 0},
    {"angle", NORMALS, 0, 0, UMB_WEIGHT_ANGLE, 0, 0},
    {"area", NORMALS, 0, 0, UMB_WEIGHT_AREA, 0, 0},
    {"Max", NORMALS, 0, 0, UMB_WEIGHT_MAX, 0, 0},
    {"centroid-area", NORMALS, 0, 0, UMB_WEIGHT_CENTROID_AREA, 0, 0},
    {"centroid", NORMALS, 0, 0, UMB_WEIGHT_CENTROID, 0, 0},
    {"inverse-root-edges", NORMALS, 0, 0, UMB_WEIGHT_INVERSE_ROOT_EDGES, 0, 0},
    {"sine", NORMALS, 0, 0, UMB_WEIGHT_SINE, 0, 0},
    {"angle-edges", NORMALS, 0, 0, UMB_WEIGHT_ANGLE_EDGES, 0, 0},
    {"tilted-sections", NORMALS, 0, 0, UMB_WEIGHT_TILTED_SECTIONS, 0, 0},
    {"jet", NORMALS, 0, 0, UMB_WEIGHT_JET, 3, 2},
    {"adaptive-jet, 4 rings", NORMALS, 0, 0, UMB_WEIGHT_ADAPTIVE_JET, 0, 4},
    {"cut along creases", CUT, 0, 0, 0, 0, 0},
    {"angle, at corners", CORNERS, 0, 0, UMB_WEIGHT_ANGLE, 0, 0},
    {"angle, at corners by index", INDEXED_CORNERS, 0, 0, UMB_WEIGHT_ANGLE, 0, 0},
    {"N_CM, at corners", CORNERS, 0, 0, UMB_WEIGHT_CONFORMAL, 0, 0},
    {"edge sections", EDGE_SECTIONS, 0, 0, UMB_SECTION_SYMMETRIC_PARABOLA, 0, 0},
    {"direction sections, one each", DIRECTION_SECTIONS, 0, 0, UMB_SECTION_SYMMETRIC_PARABOLA, 0, 0},
    {"tilted sections", CURVATURES, UMB_CURVATURE_TILTED_SECTIONS, TENSOR, 0, 0, 0},
    {"least squares", CURVATURES, UMB_CURVATURE_LEAST_SQUARES, TENSOR, 0, 0, 0},
    {"least squares, circles", CURVATURES, UMB_CURVATURE_LEAST_SQUARES, TENSOR, UMB_SECTION_CIRCLE, 0, 0},
    {"Taubin", CURVATURES, UMB_CURVATURE_TAUBIN, TENSOR, 0, 0, 0},
    {"Watanabe", CURVATURES, UMB_CURVATURE_WATANABE, PRINCIPAL | MEAN_AND_GAUSSIAN, 0, 0, 0},
    {"Meyer", CURVATURES, UMB_CURVATURE_MEYER, PRINCIPAL | MEAN_AND_GAUSSIAN, 0, 0, 0},
    {"angle defect", CURVATURES, UMB_CURVATURE_ANGLE_DEFECT, GAUSSIAN, 0, 0, 0},
    {"Rusinkiewicz", CURVATURES, UMB_CURVATURE_RUSINKIEWICZ, TENSOR, 0, 0, 0},
    {"normal cycle", CURVATURES, UMB_CURVATURE_NORMAL_CYCLE, TENSOR, 0, 0, 0},
    {"normal cycle, 2 rings", CURVATURES, UMB_CURVATURE_NORMAL_CYCLE, TENSOR, 0, 0, 2},
    {"corrected measure", CURVATURES, UMB_CURVATURE_CORRECTED_MEASURE, TENSOR, 0, 0, 0},
    {"corrected measure, 2 rings", CURVATURES, UMB_CURVATURE_CORRECTED_MEASURE, TENSOR, 0, 0, 2},
    {"quadric", CURVATURES, UMB_CURVATURE_QUADRIC, TENSOR, 0, 0, 0},
    {"quadric, 2 rings", CURVATURES, UMB_CURVATURE_QUADRIC, TENSOR, 0, 0, 2},
    {"Goldfeather", CURVATURES, UMB_CURVATURE_GOLDFEATHER, TENSOR, 0, 0, 0},
    {"jets 2, 2 rings", CURVATURES, UMB_CURVATURE_JET, TENSOR, 0, 2, 2},
    {"jets 2, 5 rings", CURVATURES, UMB_CURVATURE_JET, TENSOR, 0, 2, 5},
    {"jets 3, 2 rings", CURVATURES, UMB_CURVATURE_JET, TENSOR, 0, 3, 2},
    {"jets 4, 3 rings", CURVATURES, UMB_CURVATURE_JET, TENSOR, 0, 4, 3},
    {"adaptive jets, 3 rings", CURVATURES, UMB_CURVATURE_ADAPTIVE_JET, TENSOR, 0, 0, 3},
    {"adaptive jets, 4 rings", CURVATURES, UMB_CURVATURE_ADAPTIVE_JET, TENSOR, 0, 0, 4},
    {"adaptive jets", CURVATURES, UMB_CURVATURE_ADAPTIVE_JET, TENSOR, 0, 0, 0},
};

enum { ROOMS = 4, DOUBLES = 3 * sizeof(double) };

struct ours {
  const mesh *m;
  int fresh;
  umb_topology *topology;
  umb_cut *cut;
  void *rooms[ROOMS];
  umb_points normals[2], directions[2]; /* given ones in both scalars, made when first asked for */
};

static void check(umb_status status, const umb_error *error) {
  if (status == UMB_OK) return;
  fprintf(stderr, "%s: %s\n", umb_status_string(status), error->message);
  exit(1);
}

static size_t size_of(umb_scalar scalar) {
  return scalar == UMB_SCALAR_F64 ? sizeof(double) : sizeof(float);
}

static umb_faces faces_of(const mesh *m) {
  return (umb_faces){
      .indices = m->corners, .index_count = m->corner_count, .offsets = m->offsets, .face_count = m->polygon_count};
}

static umb_points points_of(const mesh *m, umb_scalar scalar) {
  const void *data = scalar == UMB_SCALAR_F64 ? (const void *)m->positions_double : m->positions;
  return (umb_points){.data = data, .count = m->vertex_count, .scalar = scalar};
}

static umb_topology *build(const mesh *m, uint32_t threads, umb_simd simd) {
  umb_error error = UMB_ERROR_INIT;
  umb_topology_options options = UMB_TOPOLOGY_OPTIONS_INIT;
  options.threads = threads;
  options.simd = simd;
  umb_faces faces = faces_of(m);
  umb_topology *topology = NULL;
  check(umb_topology_create(&faces, m->vertex_count, &options, &topology, &error), &error);
  return topology;
}

/* Along edges sharper than 30 degrees. */
static umb_cut *build_cut(const mesh *m, uint32_t threads, umb_simd simd) {
  umb_error error = UMB_ERROR_INIT;
  umb_topology_options options = UMB_TOPOLOGY_OPTIONS_INIT;
  options.threads = threads;
  options.simd = simd;
  umb_faces faces = faces_of(m);
  umb_points points = points_of(m, UMB_SCALAR_F32);
  umb_cut *cut = NULL;
  check(umb_cut_create(&faces, &points, NULL, &options, &cut, &error), &error);
  return cut;
}

ours *ours_new(const mesh *m, int fresh) {
  ours *o = allocate(sizeof *o);
  *o = (ours){.m = m, .fresh = fresh};
  return o;
}

void ours_free(ours *o) {
  umb_topology_destroy(o->topology);
  umb_cut_destroy(o->cut);
  for (int i = 0; i < ROOMS; i++) free(o->rooms[i]);
  for (int i = 0; i < 2; i++) {
    free((void *)o->normals[i].data);
    free((void *)o->directions[i].data);
  }
  free(o);
}

const umb_topology *ours_topology(ours *o) {
  if (!o->topology) o->topology = build(o->m, 0, UMB_SIMD_BEST);
  return o->topology;
}

const void *ours_result(const ours *o) {
  return o->rooms[0];
}

double ours_handle_bytes(ours *o) {
  umb_error error = UMB_ERROR_INIT;
  umb_topology_stats stats = UMB_TOPOLOGY_STATS_INIT;
  check(umb_topology_get_stats(ours_topology(o), &stats, &error), &error);
  return (double)stats.bytes;
}

/* ---- given normals and directions ---- */

/* Normals or directions in both scalars, of an array in double precision that becomes theirs. */
static void keep(umb_points kept[2], double *values, size_t count) {
  float *rounded = allocate(count * 3 * sizeof *rounded);
  for (size_t i = 0; i < 3 * count; i++) rounded[i] = (float)values[i];
  kept[UMB_SCALAR_F32] = (umb_points){.data = rounded, .count = count, .scalar = UMB_SCALAR_F32};
  kept[UMB_SCALAR_F64] = (umb_points){.data = values, .count = count, .scalar = UMB_SCALAR_F64};
}

static void make_given(ours *o) {
  umb_error error = UMB_ERROR_INIT;
  umb_points points = points_of(o->m, UMB_SCALAR_F64);
  umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
  umb_curvature_outputs outputs = UMB_CURVATURE_OUTPUTS_INIT;
  options.method = UMB_CURVATURE_LEAST_SQUARES;
  double *normals = allocate(points.count * DOUBLES), *directions = allocate(points.count * DOUBLES);
  outputs.normal = (umb_output){.data = normals, .scalar = UMB_SCALAR_F64};
  outputs.direction1 = (umb_output){.data = directions, .scalar = UMB_SCALAR_F64};
  check(umb_curvatures(ours_topology(o), &points, &options, &outputs, &error), &error);
  keep(o->normals, normals, points.count);
  keep(o->directions, directions, points.count);
}

/* ---- one run ---- */

/* Room for `count` results. The rooms of warm memory are large enough for whatever comes. */
static umb_output output(ours *o, int room, size_t count, umb_scalar scalar) {
  if (!o->rooms[room]) o->rooms[room] = allocate(o->fresh ? count * size_of(scalar) : o->m->corner_count * DOUBLES);
  return (umb_output){.data = o->rooms[room], .scalar = scalar};
}

static void run_normals(ours *o, const variant *v, const umb_points *points, const umb_run *how) {
  umb_error error = UMB_ERROR_INIT;
  umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
  umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT;
  umb_faces faces = faces_of(o->m);
  options.weight = v->kind;
  options.degree = v->degree;
  options.rings = v->rings;
  options.run = *how;
  outputs.normal = output(o, 0, 3 * points->count, points->scalar);
  if (v->call == NORMALS) check(umb_vertex_normals(ours_topology(o), points, &options, &outputs, &error), &error);
  else check(umb_vertex_normals_from_faces(&faces, points, &options, &outputs, &error), &error);
}

static void run_corners(ours *o, const variant *v, const umb_points *points, const umb_run *how) {
  umb_error error = UMB_ERROR_INIT;
  umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
  umb_corner_outputs outputs = UMB_CORNER_OUTPUTS_INIT;
  if (!o->cut) o->cut = build_cut(o->m, 0, UMB_SIMD_BEST);
  options.weight = v->kind;
  options.run = *how;
  if (v->call == CORNERS) outputs.corner = output(o, 0, 3 * umb_cut_corner_count(o->cut), points->scalar);
  else outputs.normal = output(o, 0, 3 * umb_cut_vertex_count(o->cut), points->scalar);
  check(umb_corner_normals(o->cut, points, &options, &outputs, &error), &error);
}

static void run_curvatures(ours *o, const variant *v, const umb_points *points, const umb_points *normals,
                           const umb_run *how) {
  umb_error error = UMB_ERROR_INIT;
  umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
  umb_curvature_outputs outputs = UMB_CURVATURE_OUTPUTS_INIT;
  size_t count = points->count;
  options.method = v->method;
  options.section = v->kind;
  options.degree = v->degree;
  options.rings = v->rings;
  options.normals = *normals;
  options.run = *how;
  if (v->gives & PRINCIPAL) {
    outputs.k1 = output(o, 0, count, points->scalar);
    outputs.k2 = output(o, 1, count, points->scalar);
  }
  if (v->gives & DIRECTIONS) {
    outputs.direction1 = output(o, 2, 3 * count, points->scalar);
    outputs.direction2 = output(o, 3, 3 * count, points->scalar);
  }
  if (v->gives & MEAN_AND_GAUSSIAN) outputs.mean = output(o, 2, count, points->scalar);
  if (v->gives & (MEAN_AND_GAUSSIAN | GAUSSIAN)) outputs.gaussian = output(o, 3, count, points->scalar);
  check(umb_curvatures(ours_topology(o), points, &options, &outputs, &error), &error);
}

static void run_sections(ours *o, const variant *v, const umb_points *points, const umb_points *normals,
                         const umb_run *how) {
  umb_error error = UMB_ERROR_INIT;
  umb_section_options options = UMB_SECTION_OPTIONS_INIT;
  umb_section_outputs outputs = UMB_SECTION_OUTPUTS_INIT;
  options.section = v->kind;
  options.normals = *normals;
  options.run = *how;
  if (v->call == EDGE_SECTIONS) {
    outputs.curvature = output(o, 0, umb_topology_ring_offsets(ours_topology(o))[points->count], points->scalar);
    check(umb_edge_sections(ours_topology(o), points, &options, &outputs, &error), &error);
  } else {
    outputs.curvature = output(o, 0, points->count, points->scalar);
    options.directions = o->directions[points->scalar];
    check(umb_direction_sections(ours_topology(o), points, &options, &outputs, &error), &error);
  }
}

/* The variant of a name, and whether it is to be on given normals. */
static const variant *find(const char *name, int *given) {
  size_t length = strlen(name), words = sizeof GIVEN - 1;
  *given = length > words && !strcmp(name + length - words, GIVEN);
  if (*given) length -= words;
  for (size_t v = 0; v < sizeof VARIANTS / sizeof *VARIANTS; v++)
    if (strlen(VARIANTS[v].name) == length && !strncmp(VARIANTS[v].name, name, length)) return &VARIANTS[v];
  fprintf(stderr, "there is no '%s'\n", name);
  exit(2);
}

void ours_run(ours *o, const char *name, umb_scalar scalar, uint32_t threads, umb_simd simd) {
  int given;
  const variant *v = find(name, &given);
  umb_points points = points_of(o->m, scalar), normals = {0};
  umb_run how = {.threads = threads, .simd = simd};
  if ((given || v->call == DIRECTION_SECTIONS) && !o->normals[0].data) make_given(o);
  if (given) normals = o->normals[scalar];
  switch (v->call) {
  case TOPOLOGY: umb_topology_destroy(build(o->m, threads, simd)); break;
  case NORMALS:
  case FROM_FACES: run_normals(o, v, &points, &how); break;
  case CUT: umb_cut_destroy(build_cut(o->m, threads, simd)); break;
  case CORNERS:
  case INDEXED_CORNERS: run_corners(o, v, &points, &how); break;
  case CURVATURES: run_curvatures(o, v, &points, &normals, &how); break;
  default: run_sections(o, v, &points, &normals, &how);
  }
  if (!o->fresh) return;
  for (int i = 0; i < ROOMS; i++) {
    free(o->rooms[i]);
    o->rooms[i] = NULL;
  }
}

void ours_run_call(void *call) {
  const ours_call *c = call;
  ours_run(c->o, c->name, c->scalar, c->threads, c->simd);
}
