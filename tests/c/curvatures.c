/*
 * Curvatures, sections, polylines and models: every method with every output that it has, on triangles, polygons and
 * broken meshes. Run under every sanitizer; exactness is tested from Rust.
 */
#include "mesh.h"

/* Kinds of outputs, as the table in the header has them. */
enum {
  PRINCIPAL = 1,
  DIRECTIONS = 2,
  MEAN = 4,
  GAUSSIAN = 8,
  AREA = 16,
  INTEGRATED_MEAN = 32,
  INTEGRATED_GAUSSIAN = 64,
  RESIDUAL = 128,
  CONDITION = 256,
  FREEDOM = 512,
  NORMAL = 1024
};

#define FIELD(name) offsetof(umb_curvature_outputs, name)
static const struct {
  size_t field, components;
  int kind;
} OUTPUTS[] = {
    {FIELD(k1), 1, PRINCIPAL},
    {FIELD(k2), 1, PRINCIPAL},
    {FIELD(direction1), 3, DIRECTIONS},
    {FIELD(direction2), 3, DIRECTIONS},
    {FIELD(mean), 1, MEAN},
    {FIELD(gaussian), 1, GAUSSIAN},
    {FIELD(mean_normal), 3, MEAN},
    {FIELD(area), 1, AREA},
    {FIELD(integrated_mean), 1, INTEGRATED_MEAN},
    {FIELD(integrated_gaussian), 1, INTEGRATED_GAUSSIAN},
    {FIELD(shape_index), 1, PRINCIPAL},
    {FIELD(curvedness), 1, PRINCIPAL},
    {FIELD(residual), 1, RESIDUAL},
    {FIELD(condition), 1, CONDITION},
    {FIELD(degrees_of_freedom), 1, FREEDOM},
    {FIELD(normal), 3, NORMAL},
};
enum { OUTPUT_COUNT = sizeof OUTPUTS / sizeof *OUTPUTS };

/* What each method has, and how far from 1/r its k1 and k2 are on a coarse sphere; 1 where it is not looked at. */
static const struct {
  umb_curvature_method method;
  int kinds;
  double tolerance;
} METHODS[] = {
    {UMB_CURVATURE_ADAPTIVE_JET, PRINCIPAL | DIRECTIONS | MEAN | GAUSSIAN | RESIDUAL | FREEDOM, 0.01},
    {UMB_CURVATURE_JET, PRINCIPAL | DIRECTIONS | MEAN | GAUSSIAN | RESIDUAL | CONDITION, 0.1},
    {UMB_CURVATURE_QUADRIC, PRINCIPAL | DIRECTIONS | MEAN | GAUSSIAN | RESIDUAL | CONDITION, 0.2},
    {UMB_CURVATURE_GOLDFEATHER, PRINCIPAL | DIRECTIONS | MEAN | GAUSSIAN | RESIDUAL | CONDITION, 0.2},
    {UMB_CURVATURE_TILTED_SECTIONS, PRINCIPAL | DIRECTIONS | MEAN | GAUSSIAN, 1e-5},
    {UMB_CURVATURE_LEAST_SQUARES, PRINCIPAL | DIRECTIONS | MEAN | GAUSSIAN | RESIDUAL, 0.2},
    {UMB_CURVATURE_TAUBIN, PRINCIPAL | DIRECTIONS | MEAN | GAUSSIAN, 1},
    {UMB_CURVATURE_WATANABE, PRINCIPAL | MEAN | GAUSSIAN, 0.3},
    {UMB_CURVATURE_MEYER, PRINCIPAL | MEAN | GAUSSIAN | AREA | INTEGRATED_MEAN | INTEGRATED_GAUSSIAN, 1},
    {UMB_CURVATURE_ANGLE_DEFECT, GAUSSIAN | AREA | INTEGRATED_GAUSSIAN, 1},
    {UMB_CURVATURE_RUSINKIEWICZ, PRINCIPAL | DIRECTIONS | MEAN | GAUSSIAN, 0.2},
    {UMB_CURVATURE_NORMAL_CYCLE, PRINCIPAL | DIRECTIONS | MEAN | GAUSSIAN | AREA | INTEGRATED_MEAN, 1},
    {UMB_CURVATURE_CORRECTED_MEASURE,
     PRINCIPAL | DIRECTIONS | MEAN | GAUSSIAN | AREA | INTEGRATED_MEAN | INTEGRATED_GAUSSIAN, 0.2},
};
enum { METHOD_COUNT = sizeof METHODS / sizeof *METHODS };

static umb_output *field(umb_curvature_outputs *outputs, size_t which) {
  return (umb_output *)(void *)((unsigned char *)outputs + OUTPUTS[which].field);
}

/* Every output of every method; those that it does not have are refused. */
static void methods(const struct mesh *mesh, double radius) {
  umb_error error = UMB_ERROR_INIT;
  umb_topology *topology = topology_of(mesh, 0);
  unsigned char *status = (unsigned char *)memory(mesh->vertex_count);
  for (size_t m = 0; m < METHOD_COUNT; m++) {
    for (umb_scalar scalar = UMB_SCALAR_F32; scalar <= UMB_SCALAR_F64; scalar++) {
      umb_points points = points_of(mesh, scalar);
      umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
      umb_curvature_outputs outputs = UMB_CURVATURE_OUTPUTS_INIT;
      struct array arrays[OUTPUT_COUNT];
      options.method = METHODS[m].method;
      options.section = UMB_SECTION_CIRCLE;
      options.weight = UMB_WEIGHT_MAX;
      outputs.status = bytes_of(status);
      for (size_t i = 0; i < OUTPUT_COUNT; i++) {
        arrays[i] = array_of(mesh->vertex_count, OUTPUTS[i].components, i % 3, scalar);
        if (METHODS[m].kinds & OUTPUTS[i].kind || OUTPUTS[i].kind == NORMAL) {
          *field(&outputs, i) = output_of(&arrays[i]);
        } else {
          umb_curvature_outputs alone = UMB_CURVATURE_OUTPUTS_INIT;
          *field(&alone, i) = output_of(&arrays[i]);
          CHECK(umb_curvatures(topology, &points, &options, &alone, &error) == UMB_ERROR_NOT_APPLICABLE);
        }
      }
      SUCCEEDS(umb_curvatures(topology, &points, &options, &outputs, &error));
      for (size_t i = 0; i < OUTPUT_COUNT; i++) {
        if (!(METHODS[m].kinds & OUTPUTS[i].kind)) continue;
        for (size_t v = 0; v < mesh->vertex_count; v++) {
          for (size_t c = 0; c < OUTPUTS[i].components; c++) CHECK(isfinite(get(&arrays[i], v, c)));
          if (OUTPUTS[i].kind == DIRECTIONS && !(status[v] & ~UMB_VERTEX_BOUNDARY)) {
            CHECK(fabs(length_of(&arrays[i], v) - 1) < 1e-6);
          }
          if (OUTPUTS[i].kind == PRINCIPAL && i < 2 && radius > 0 && METHODS[m].tolerance < 1) {
            CHECK(fabs(get(&arrays[i], v, 0) * radius - 1) < METHODS[m].tolerance);
          }
        }
      }
      if (METHODS[m].kinds & INTEGRATED_GAUSSIAN && radius > 0) {
        double sum = 0;
        for (size_t v = 0; v < mesh->vertex_count; v++) sum += get(&arrays[9], v, 0);
        CHECK(fabs(sum / (4 * PI) - 1) < 0.05);
      }
      for (size_t i = 0; i < OUTPUT_COUNT; i++) free(arrays[i].data);
    }
  }
  free(status);
  umb_topology_destroy(topology);
}

/* Degrees, rings, balls, sections, weights and given normals; threads and lists give the same bytes. */
static void options_of_methods(const struct mesh *mesh) {
  umb_error error = UMB_ERROR_INIT;
  umb_topology *topology = topology_of(mesh, 0);
  umb_points points = points_of(mesh, UMB_SCALAR_F64);
  struct array normals = array_of(mesh->vertex_count, 3, 1, UMB_SCALAR_F32);
  struct array all = array_of(mesh->vertex_count, 3, 0, UMB_SCALAR_F64);
  struct array again = array_of(mesh->vertex_count, 3, 0, UMB_SCALAR_F64);
  uint32_t list[4] = {1, 0, 5, 1};
  umb_normal_outputs normal_outputs = UMB_NORMAL_OUTPUTS_INIT;
  normal_outputs.normal = output_of(&normals);
  SUCCEEDS(umb_vertex_normals(topology, &points, NULL, &normal_outputs, &error));
  for (uint32_t variant = 0; variant < 24; variant++) {
    umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
    umb_curvature_outputs outputs = UMB_CURVATURE_OUTPUTS_INIT;
    switch (variant % 6) {
      case 0:
        options.method = UMB_CURVATURE_JET, options.degree = 2 + variant % 3, options.rings = 1 + variant / 6;
        break;
      case 1:
        options.method = UMB_CURVATURE_LEAST_SQUARES, options.section = variant / 6;
        break;
      case 2:
        options.method = UMB_CURVATURE_NORMAL_CYCLE, options.radius = 0.2 * (1 + variant / 6);
        break;
      case 3:
        options.method = UMB_CURVATURE_RUSINKIEWICZ, options.weight = UMB_WEIGHT_JET, options.normal_degree = 1 + variant / 6;
        break;
      case 4:
        options.method = UMB_CURVATURE_CORRECTED_MEASURE, options.rings = 1 + variant / 6;
        options.normals.data = normals.data;
        options.normals.count = mesh->vertex_count;
        options.normals.stride = normals.stride;
        break;
      default:
        options.method = UMB_CURVATURE_ADAPTIVE_JET, options.rings = 2 + variant / 6;
    }
    outputs.mean_normal = output_of(&all);
    options.run.threads = 1;
    SUCCEEDS(umb_curvatures(topology, &points, &options, &outputs, &error));
    outputs.mean_normal = output_of(&again);
    options.run.threads = 3;
    SUCCEEDS(umb_curvatures(topology, &points, &options, &outputs, &error));
    CHECK(memcmp(all.data, again.data, all.bytes) == 0);
    options.run.vertices = list;
    options.run.vertex_count = 4;
    SUCCEEDS(umb_curvatures(topology, &points, &options, &outputs, &error));
    CHECK(memcmp(all.data, again.data, all.bytes) == 0);
  }
  free(normals.data);
  free(all.data);
  free(again.data);
  umb_topology_destroy(topology);
}

/* What a call learns by itself, handed in, gives the same bytes. */
static void models(const struct mesh *mesh) {
  umb_error error = UMB_ERROR_INIT;
  umb_topology *topology = topology_of(mesh, 0);
  umb_points points = points_of(mesh, UMB_SCALAR_F32);
  umb_adaptive_model model = UMB_ADAPTIVE_MODEL_INIT;
  umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
  umb_curvature_outputs outputs = UMB_CURVATURE_OUTPUTS_INIT;
  struct array learned = array_of(mesh->vertex_count, 1, 0, UMB_SCALAR_F32);
  struct array given = array_of(mesh->vertex_count, 1, 0, UMB_SCALAR_F32);
  outputs.k1 = output_of(&learned);
  SUCCEEDS(umb_curvatures(topology, &points, NULL, &outputs, &error));
  SUCCEEDS(umb_learn_model(topology, &points, NULL, &model, &error));
  CHECK(model.struct_size == sizeof model && model.edge_length > 0 && model.noise > 0 && model.sample > 0);
  options.model = &model;
  outputs.k1 = output_of(&given);
  SUCCEEDS(umb_curvatures(topology, &points, &options, &outputs, &error));
  CHECK(memcmp(learned.data, given.data, given.bytes) == 0);
  free(learned.data);
  free(given.data);
  umb_topology_destroy(topology);
}

static void sections(const struct mesh *mesh, double radius) {
  umb_error error = UMB_ERROR_INIT;
  umb_topology *topology = topology_of(mesh, 0);
  const uint32_t *offsets = umb_topology_ring_offsets(topology);
  size_t count = mesh->vertex_count, entries = offsets[count];
  double shared[6] = {1, 0, 0.5, 0, 1, 0.5};
  unsigned char *status = (unsigned char *)memory(entries > 2 * count ? entries : 2 * count);
  for (umb_section section = UMB_SECTION_SYMMETRIC_PARABOLA; section <= UMB_SECTION_LENGTH_PARABOLA; section++) {
    for (umb_scalar scalar = UMB_SCALAR_F32; scalar <= UMB_SCALAR_F64; scalar++) {
      umb_points points = points_of(mesh, scalar);
      umb_section_options options = UMB_SECTION_OPTIONS_INIT;
      umb_section_outputs outputs = UMB_SECTION_OUTPUTS_INIT;
      struct array edges = array_of(entries, 1, 1, scalar), cuts = array_of(2 * count, 1, 0, scalar);
      struct array own = array_of(count, 1, 2, scalar), normals = array_of(count, 3, 0, scalar);
      options.section = section;
      options.weight = UMB_WEIGHT_MAX;
      outputs.curvature = output_of(&edges);
      outputs.status = bytes_of(status);
      outputs.normal = output_of(&normals);
      SUCCEEDS(umb_edge_sections(topology, &points, &options, &outputs, &error));
      for (size_t entry = 0; entry < entries; entry++) {
        double found = get(&edges, entry, 0);
        CHECK(isfinite(found));
        if (radius > 0 && section == UMB_SECTION_CIRCLE) CHECK(fabs(found * radius - 1) < 1e-4);
      }
      options.directions.data = shared;
      options.directions.count = 2;
      options.directions.scalar = UMB_SCALAR_F64;
      options.shared = 1;
      outputs.curvature = output_of(&cuts);
      SUCCEEDS(umb_direction_sections(topology, &points, &options, &outputs, &error));
      for (size_t cut = 0; cut < 2 * count; cut++) CHECK(isfinite(get(&cuts, cut, 0)));
      /* Any vectors do as directions of each vertex's own: the positions, turned. */
      options.directions = points;
      options.directions.data = memory(3 * count * scalar_size(scalar));
      memcpy((void *)(uintptr_t)options.directions.data, points.data, 3 * count * scalar_size(scalar));
      options.shared = 0;
      outputs.curvature = output_of(&own);
      SUCCEEDS(umb_direction_sections(topology, &points, &options, &outputs, &error));
      for (size_t v = 0; v < count; v++) CHECK(isfinite(get(&own, v, 0)));
      free((void *)(uintptr_t)options.directions.data);
      free(edges.data);
      free(cuts.data);
      free(own.data);
      free(normals.data);
    }
  }
  free(status);
  umb_topology_destroy(topology);
}

static void polylines(void) {
  enum { COUNT = 37 };
  umb_error error = UMB_ERROR_INIT;
  for (uint32_t dimension = 2; dimension <= 3; dimension++) {
    for (umb_scalar scalar = UMB_SCALAR_F32; scalar <= UMB_SCALAR_F64; scalar++) {
      struct array points = array_of(COUNT, dimension, 1, scalar);
      struct array found[4];
      unsigned char status[COUNT];
      umb_polyline polyline = {0};
      umb_polyline_options options = UMB_POLYLINE_OPTIONS_INIT;
      umb_polyline_outputs outputs = UMB_POLYLINE_OUTPUTS_INIT;
      for (size_t i = 0; i < COUNT; i++) {
        double turn = 2 * PI * (double)i / COUNT, place[3] = {2 * cos(turn), 2 * sin(turn), 5};
        for (size_t c = 0; c < dimension; c++) {
          unsigned char *at = points.data + i * points.stride + c * scalar_size(scalar);
          float rounded = (float)place[c];
          if (scalar == UMB_SCALAR_F64) memcpy(at, &place[c], sizeof place[c]);
          else memcpy(at, &rounded, sizeof rounded);
        }
      }
      polyline.data = points.data;
      polyline.count = COUNT;
      polyline.stride = points.stride;
      polyline.scalar = scalar;
      polyline.dimension = dimension;
      for (size_t i = 0; i < 4; i++) found[i] = array_of(COUNT, 1, i, scalar);
      outputs.circle = output_of(&found[0]);
      outputs.parabola = output_of(&found[1]);
      outputs.length_parabola = output_of(&found[2]);
      outputs.symmetric_parabola = output_of(&found[3]);
      outputs.status = bytes_of(status);
      options.run.threads = 2;
      for (uint32_t closed = 0; closed < 2; closed++) {
        polyline.closed = closed;
        SUCCEEDS(umb_polyline_curvatures(&polyline, &options, &outputs, &error));
        for (size_t i = 0; i < COUNT; i++) {
          int end = !closed && (i == 0 || i + 1 == COUNT);
          CHECK(status[i] == (end ? UMB_POLYLINE_END : 0));
          for (size_t kind = 0; kind < 4; kind++) {
            CHECK(fabs(get(&found[kind], i, 0) * 2 - (end ? 0 : 1)) < 0.02);
          }
        }
      }
      for (size_t i = 0; i < 4; i++) free(found[i].data);
      free(points.data);
    }
  }
}

int main(void) {
  struct mesh meshes[] = {sphere(2, 24, 16), torus(24, 18), broken()};
  for (size_t i = 0; i < 3; i++) {
    methods(&meshes[i], i == 0 ? 2 : 0);
    options_of_methods(&meshes[i]);
    models(&meshes[i]);
    sections(&meshes[i], i == 0 ? 2 : 0);
  }
  polylines();
  for (size_t i = 0; i < 3; i++) mesh_free(&meshes[i]);
  puts("curvatures: all calls are as they should be");
  return 0;
}
