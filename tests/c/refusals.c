/*
 * Calls that must fail: every kind of mistake that a caller can make, each with its status and its element, and nothing
 * written. Run under every sanitizer, since it is here that the library could touch memory that is not there.
 */
#include "mesh.h"

static struct mesh mesh;
static umb_topology *topology;
static struct array normals;

static umb_points points(void) { return points_of(&mesh, UMB_SCALAR_F64); }

static umb_normal_outputs outputs(void) {
  umb_normal_outputs wanted = UMB_NORMAL_OUTPUTS_INIT;
  wanted.normal = output_of(&normals);
  return wanted;
}

/* The call failed like this, said so in the error, and wrote nothing. */
static void refused(umb_status found, umb_status expected, const umb_error *error, uint64_t element) {
  fails(found, expected, error, element);
  for (size_t i = 0; i < normals.bytes; i++) CHECK(normals.data[i] == 0x5a);
}

static void of_vertex_normals(const umb_points *points_given, const umb_normal_options *options,
                              const umb_normal_outputs *wanted, umb_status expected, uint64_t element) {
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(&mesh);
  refused(umb_vertex_normals(topology, points_given, options, wanted, &error), expected, &error, element);
  refused(umb_vertex_normals_from_faces(&faces, points_given, options, wanted, &error), expected, &error, element);
  /* Without an error to write to. */
  CHECK(umb_vertex_normals(topology, points_given, options, wanted, NULL) == expected);
}

static void bad_points(void) {
  umb_normal_outputs wanted = outputs();
  umb_points bad = points();
  of_vertex_normals(NULL, NULL, &wanted, UMB_ERROR_NULL_POINTER, UMB_NO_ELEMENT);
  bad.data = NULL;
  of_vertex_normals(&bad, NULL, &wanted, UMB_ERROR_NULL_POINTER, UMB_NO_ELEMENT);
  bad = points(), bad.stride = 16;
  of_vertex_normals(&bad, NULL, &wanted, UMB_ERROR_STRIDE, UMB_NO_ELEMENT);
  bad = points(), bad.stride = 28;
  of_vertex_normals(&bad, NULL, &wanted, UMB_ERROR_STRIDE, UMB_NO_ELEMENT);
  bad = points(), bad.stride = SIZE_MAX & ~(size_t)7;
  of_vertex_normals(&bad, NULL, &wanted, UMB_ERROR_SIZE, UMB_NO_ELEMENT);
  bad = points(), bad.data = (const char *)bad.data + 4;
  of_vertex_normals(&bad, NULL, &wanted, UMB_ERROR_MISALIGNED, UMB_NO_ELEMENT);
  bad = points(), bad.scalar = 2;
  of_vertex_normals(&bad, NULL, &wanted, UMB_ERROR_UNKNOWN_CONSTANT, 2);
  bad = points(), bad.reserved = 1;
  of_vertex_normals(&bad, NULL, &wanted, UMB_ERROR_UNKNOWN_FIELD, offsetof(umb_points, reserved));
  for (size_t vertex = 0; vertex < mesh.vertex_count; vertex += 7) {
    double good = mesh.positions[3 * vertex + 1];
    bad = points();
    mesh.positions[3 * vertex + 1] = vertex % 2 ? (double)NAN : (double)INFINITY;
    of_vertex_normals(&bad, NULL, &wanted, UMB_ERROR_NON_FINITE, vertex);
    mesh.positions[3 * vertex + 1] = good;
  }
}

static void bad_options(void) {
  umb_normal_outputs wanted = outputs();
  umb_points given = points();
  umb_normal_options bad = UMB_NORMAL_OPTIONS_INIT;
  const uint32_t list[3] = {2, 100000, 1};
  bad.struct_size = 4;
  of_vertex_normals(&given, &bad, &wanted, UMB_ERROR_STRUCT_SIZE, UMB_NO_ELEMENT);
  bad.struct_size = 4097;
  of_vertex_normals(&given, &bad, &wanted, UMB_ERROR_STRUCT_SIZE, UMB_NO_ELEMENT);
  bad.struct_size = UINT32_MAX;
  of_vertex_normals(&given, &bad, &wanted, UMB_ERROR_STRUCT_SIZE, UMB_NO_ELEMENT);
  bad.struct_size = sizeof bad;
  bad.weight = UMB_WEIGHT_TILTED_SECTIONS + 1;
  of_vertex_normals(&given, &bad, &wanted, UMB_ERROR_UNKNOWN_CONSTANT, bad.weight);
  bad.weight = UMB_WEIGHT_JET, bad.degree = 5;
  of_vertex_normals(&given, &bad, &wanted, UMB_ERROR_OPTION_OUT_OF_RANGE, UMB_NO_ELEMENT);
  bad.degree = 0, bad.rings = 9;
  of_vertex_normals(&given, &bad, &wanted, UMB_ERROR_OPTION_OUT_OF_RANGE, UMB_NO_ELEMENT);
  bad.rings = 0, bad.run.simd = 5;
  of_vertex_normals(&given, &bad, &wanted, UMB_ERROR_UNKNOWN_CONSTANT, 5);
  bad.run.simd = 0, bad.run.vertex_count = 1;
  of_vertex_normals(&given, &bad, &wanted, UMB_ERROR_NULL_POINTER, UMB_NO_ELEMENT);
  bad.run.vertices = list, bad.run.vertex_count = 3;
  of_vertex_normals(&given, &bad, &wanted, UMB_ERROR_INDEX_OUT_OF_RANGE, 1);
}

static void bad_outputs(void) {
  umb_points given = points();
  umb_normal_outputs bad = outputs();
  of_vertex_normals(&given, NULL, NULL, UMB_ERROR_NULL_POINTER, UMB_NO_ELEMENT);
  bad.struct_size = 8;
  of_vertex_normals(&given, NULL, &bad, UMB_ERROR_STRUCT_SIZE, UMB_NO_ELEMENT);
  bad = outputs(), bad.reserved = 1;
  of_vertex_normals(&given, NULL, &bad, UMB_ERROR_UNKNOWN_FIELD, offsetof(umb_normal_outputs, reserved));
  bad = outputs(), bad.normal.stride = 8;
  of_vertex_normals(&given, NULL, &bad, UMB_ERROR_STRIDE, UMB_NO_ELEMENT);
  bad = outputs(), bad.normal.data = normals.data + 4;
  of_vertex_normals(&given, NULL, &bad, UMB_ERROR_MISALIGNED, UMB_NO_ELEMENT);
  bad = outputs(), bad.sum.data = normals.data, bad.sum.scalar = 9;
  of_vertex_normals(&given, NULL, &bad, UMB_ERROR_UNKNOWN_CONSTANT, 9);
  bad = outputs(), bad.normal.stride = SIZE_MAX & ~(size_t)7;
  of_vertex_normals(&given, NULL, &bad, UMB_ERROR_SIZE, UMB_NO_ELEMENT);
}

static void of_faces(const umb_faces *faces, umb_status expected, uint64_t element) {
  umb_error error = UMB_ERROR_INIT;
  umb_topology *untouched = topology;
  umb_points given = points();
  umb_face_outputs wanted = UMB_FACE_OUTPUTS_INIT;
  wanted.normal = output_of(&normals);
  for (uint32_t threads = 1; threads <= 3; threads += 2) {
    umb_topology_options options = UMB_TOPOLOGY_OPTIONS_INIT;
    options.threads = threads;
    refused(umb_topology_create(faces, mesh.vertex_count, &options, &untouched, &error), expected, &error, element);
    CHECK(untouched == topology);
  }
  refused(umb_face_normals(faces, &given, NULL, &wanted, &error), expected, &error, element);
}

static void bad_faces(void) {
  umb_faces bad = faces_of(&mesh);
  uint32_t *index = mesh.indices, good = index[5];
  uint32_t offsets[] = {0, 3, 2, 3 * 4};
  of_faces(NULL, UMB_ERROR_NULL_POINTER, UMB_NO_ELEMENT);
  bad.indices = NULL;
  of_faces(&bad, UMB_ERROR_NULL_POINTER, UMB_NO_ELEMENT);
  bad = faces_of(&mesh), bad.index_count--;
  of_faces(&bad, UMB_ERROR_SIZE, UMB_NO_ELEMENT);
  bad = faces_of(&mesh), bad.index_count = SIZE_MAX / 3 * 3, bad.face_count = 0;
  of_faces(&bad, UMB_ERROR_SIZE, UMB_NO_ELEMENT);
  bad = faces_of(&mesh), bad.arity = 2;
  of_faces(&bad, UMB_ERROR_SIZE, UMB_NO_ELEMENT);
  bad = faces_of(&mesh), bad.index = 3;
  of_faces(&bad, UMB_ERROR_UNKNOWN_CONSTANT, 3);
  bad = faces_of(&mesh), bad.indices = (const char *)bad.indices + 1;
  of_faces(&bad, UMB_ERROR_MISALIGNED, UMB_NO_ELEMENT);
  bad = faces_of(&mesh), index[5] = (uint32_t)mesh.vertex_count;
  of_faces(&bad, UMB_ERROR_INDEX_OUT_OF_RANGE, 5);
  bad.index = UMB_INDEX_I32, index[5] = UINT32_MAX;
  of_faces(&bad, UMB_ERROR_INDEX_OUT_OF_RANGE, 5);
  index[5] = good;
  bad = faces_of(&mesh), bad.offsets = offsets, bad.face_count = 3, bad.index_count = 12;
  of_faces(&bad, UMB_ERROR_OFFSETS, 1);
  offsets[2] = 6, offsets[3] = 13;
  of_faces(&bad, UMB_ERROR_OFFSETS, 2);
}

static void bad_topologies(void) {
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(&mesh);
  umb_points given = points();
  umb_normal_outputs wanted = outputs();
  umb_topology_options options = UMB_TOPOLOGY_OPTIONS_INIT;
  umb_topology_stats stats = UMB_TOPOLOGY_STATS_INIT;
  umb_topology *made = NULL;
  umb_fan fan;
  size_t number = 7, none = mesh.vertex_count;
  refused(umb_topology_create(&faces, none, NULL, NULL, &error), UMB_ERROR_NULL_POINTER, &error, UMB_NO_ELEMENT);
  refused(umb_topology_create(&faces, (size_t)UINT32_MAX + 1, NULL, &made, &error), UMB_ERROR_TOO_LARGE, &error, UMB_NO_ELEMENT);
  options.reserved = 1;
  refused(umb_topology_create(&faces, none, &options, &made, &error), UMB_ERROR_UNKNOWN_FIELD, &error,
          offsetof(umb_topology_options, reserved));
  refused(umb_vertex_normals(NULL, &given, NULL, &wanted, &error), UMB_ERROR_NULL_POINTER, &error, UMB_NO_ELEMENT);
  given.count--;
  refused(umb_vertex_normals(topology, &given, NULL, &wanted, &error), UMB_ERROR_SIZE, &error, UMB_NO_ELEMENT);
  refused(umb_topology_valence(topology, none, &number, &error), UMB_ERROR_INDEX_OUT_OF_RANGE, &error, none);
  refused(umb_topology_valence(topology, 0, NULL, &error), UMB_ERROR_NULL_POINTER, &error, UMB_NO_ELEMENT);
  refused(umb_topology_fan_count(topology, none, &number, &error), UMB_ERROR_INDEX_OUT_OF_RANGE, &error, none);
  refused(umb_topology_fan(topology, 0, 1, &fan, &error), UMB_ERROR_INDEX_OUT_OF_RANGE, &error, 1);
  refused(umb_topology_fan(NULL, 0, 0, &fan, &error), UMB_ERROR_NULL_POINTER, &error, UMB_NO_ELEMENT);
  refused(umb_topology_get_stats(topology, NULL, &error), UMB_ERROR_NULL_POINTER, &error, UMB_NO_ELEMENT);
  stats.struct_size = 8;
  refused(umb_topology_get_stats(topology, &stats, &error), UMB_ERROR_STRUCT_SIZE, &error, UMB_NO_ELEMENT);
  CHECK(number == 7 && made == NULL && stats.vertex_count == 0);
  CHECK(umb_topology_vertex_count(NULL) == 0 && umb_topology_face_count(NULL) == 0);
  CHECK(umb_topology_flags(NULL) == NULL && umb_topology_ring_offsets(NULL) == NULL);
  CHECK(umb_topology_ring_neighbours(NULL) == NULL);
  umb_topology_destroy(NULL);
}

static void bad_curvatures(void) {
  umb_error error = UMB_ERROR_INIT;
  umb_points given = points();
  umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
  umb_curvature_outputs wanted = UMB_CURVATURE_OUTPUTS_INIT;
  umb_section_options cuts = UMB_SECTION_OPTIONS_INIT;
  umb_section_outputs found = UMB_SECTION_OUTPUTS_INIT;
  umb_adaptive_model model = UMB_ADAPTIVE_MODEL_INIT;
  double direction[3] = {1, 0, (double)NAN};
  wanted.normal = output_of(&normals);
  options.method = UMB_CURVATURE_CORRECTED_MEASURE + 1;
  refused(umb_curvatures(topology, &given, &options, &wanted, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, options.method);
  options.method = UMB_CURVATURE_JET, options.degree = 9;
  refused(umb_curvatures(topology, &given, &options, &wanted, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, UMB_NO_ELEMENT);
  options.degree = 0, options.method = UMB_CURVATURE_TAUBIN, wanted.area = output_of(&normals);
  refused(umb_curvatures(topology, &given, &options, &wanted, &error), UMB_ERROR_NOT_APPLICABLE, &error, UMB_NO_ELEMENT);
  wanted.area.data = NULL, options.method = UMB_CURVATURE_ADAPTIVE_JET;
  /* A model that nothing was learned into. */
  options.model = &model;
  refused(umb_curvatures(topology, &given, &options, &wanted, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, UMB_NO_ELEMENT);
  options.model = NULL;
  refused(umb_learn_model(topology, &given, NULL, NULL, &error), UMB_ERROR_NULL_POINTER, &error, UMB_NO_ELEMENT);
  found.normal = output_of(&normals);
  refused(umb_direction_sections(topology, &given, NULL, &found, &error), UMB_ERROR_NULL_POINTER, &error, UMB_NO_ELEMENT);
  cuts.shared = 1, cuts.directions.data = direction, cuts.directions.count = 1, cuts.directions.scalar = UMB_SCALAR_F64;
  refused(umb_direction_sections(topology, &given, &cuts, &found, &error), UMB_ERROR_NON_FINITE, &error, 0);
  cuts.shared = 0, cuts.directions.data = NULL, cuts.directions.count = 0, cuts.section = 4;
  refused(umb_edge_sections(topology, &given, &cuts, &found, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 4);
}

static void bad_polylines(void) {
  umb_error error = UMB_ERROR_INIT;
  double coordinates[6] = {0, 0, 1, 0, 1, 1};
  umb_polyline polyline = {0};
  umb_polyline_options options = UMB_POLYLINE_OPTIONS_INIT;
  umb_polyline_outputs wanted = UMB_POLYLINE_OUTPUTS_INIT;
  wanted.circle = output_of(&normals);
  refused(umb_polyline_curvatures(NULL, NULL, &wanted, &error), UMB_ERROR_NULL_POINTER, &error, UMB_NO_ELEMENT);
  polyline.count = 3, polyline.scalar = UMB_SCALAR_F64, polyline.dimension = 2;
  refused(umb_polyline_curvatures(&polyline, NULL, &wanted, &error), UMB_ERROR_NULL_POINTER, &error, UMB_NO_ELEMENT);
  polyline.data = coordinates, polyline.dimension = 4;
  refused(umb_polyline_curvatures(&polyline, NULL, &wanted, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 4);
  polyline.dimension = 2, polyline.closed = 2;
  refused(umb_polyline_curvatures(&polyline, NULL, &wanted, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 2);
  polyline.closed = 0, coordinates[4] = -(double)INFINITY;
  refused(umb_polyline_curvatures(&polyline, NULL, &wanted, &error), UMB_ERROR_NON_FINITE, &error, 2);
  coordinates[4] = 1, options.reserved = 1;
  refused(umb_polyline_curvatures(&polyline, &options, &wanted, &error), UMB_ERROR_UNKNOWN_FIELD, &error, 4);
}

/* An error struct that is too short for its first version is left alone. */
static void short_errors(void) {
  umb_error error = UMB_ERROR_INIT;
  error.struct_size = 12;
  error.status = -5;
  CHECK(umb_topology_valence(NULL, 0, NULL, &error) == UMB_ERROR_NULL_POINTER && error.status == -5);
}

int main(void) {
  mesh = sphere(1, 12, 9);
  topology = topology_of(&mesh, 0);
  normals = array_of(mesh.vertex_count, 3, 0, UMB_SCALAR_F64);
  bad_points();
  bad_options();
  bad_outputs();
  bad_faces();
  bad_topologies();
  bad_curvatures();
  bad_polylines();
  short_errors();
  free(normals.data);
  umb_topology_destroy(topology);
  mesh_free(&mesh);
  puts("refusals: every mistake has its status");
  return 0;
}
