/*
 * A program that was built against the header of version 0.1.0, which is kept for it, and runs with the library of today: every
 * function of that version does what it did, and structs are read by the size that the program gives them.
 */
#include "../abi/umbilic-0.1.0.h"

/* mesh.h must not bring in the present header: its guard is the same. */
#include "mesh.h"

static umb_error error = UMB_ERROR_INIT;

/* A pyramid over a square, its normals known. */
static void every_function(void) {
  static const double corners[15] = {1, 1, 0, -1, 1, 0, -1, -1, 0, 1, -1, 0, 0, 0, 1};
  static const uint32_t triangles[18] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
  double normals[15], face_normals[18], numbers[64];
  size_t valence = 0, fan_count = 0;
  umb_faces faces = {triangles, 18, NULL, 6, UMB_INDEX_U32, 3};
  umb_points points = {corners, 5, 0, UMB_SCALAR_F64, 0};
  umb_topology_options topology_options = UMB_TOPOLOGY_OPTIONS_INIT;
  umb_topology_stats stats = UMB_TOPOLOGY_STATS_INIT;
  umb_normal_options normal_options = UMB_NORMAL_OPTIONS_INIT;
  umb_normal_outputs normal_outputs = UMB_NORMAL_OUTPUTS_INIT;
  umb_face_options face_options = UMB_FACE_OPTIONS_INIT;
  umb_face_outputs face_outputs = UMB_FACE_OUTPUTS_INIT;
  umb_curvature_options curvature_options = UMB_CURVATURE_OPTIONS_INIT;
  umb_curvature_outputs curvature_outputs = UMB_CURVATURE_OUTPUTS_INIT;
  umb_section_options section_options = UMB_SECTION_OPTIONS_INIT;
  umb_section_outputs section_outputs = UMB_SECTION_OUTPUTS_INIT;
  umb_polyline polyline = {corners, 4, 0, UMB_SCALAR_F64, 3, 1, 0};
  umb_polyline_options polyline_options = UMB_POLYLINE_OPTIONS_INIT;
  umb_polyline_outputs polyline_outputs = UMB_POLYLINE_OUTPUTS_INIT;
  umb_adaptive_model model = UMB_ADAPTIVE_MODEL_INIT;
  umb_topology *topology = NULL;
  umb_fan fan;

  SUCCEEDS(umb_topology_create(&faces, 5, &topology_options, &topology, &error));
  CHECK(umb_topology_vertex_count(topology) == 5 && umb_topology_face_count(topology) == 6);
  CHECK(umb_topology_flags(topology)[4] == 0);
  CHECK(umb_topology_ring_offsets(topology)[5] == 18 && umb_topology_ring_neighbours(topology) != NULL);
  SUCCEEDS(umb_topology_get_stats(topology, &stats, &error));
  CHECK(stats.euler_characteristic == 2 && stats.edge_count == 9 && stats.bytes > 0);
  SUCCEEDS(umb_topology_valence(topology, 4, &valence, &error));
  SUCCEEDS(umb_topology_fan_count(topology, 4, &fan_count, &error));
  SUCCEEDS(umb_topology_fan(topology, 4, 0, &fan, &error));
  CHECK(valence == 4 && fan_count == 1 && fan.neighbour_count == 4 && fan.closed == 1);

  normal_options.weight = UMB_WEIGHT_MAX;
  normal_outputs.normal.data = normals;
  normal_outputs.normal.scalar = UMB_SCALAR_F64;
  SUCCEEDS(umb_vertex_normals(topology, &points, &normal_options, &normal_outputs, &error));
  CHECK(fabs(normals[14] - 1) < 1e-15);
  SUCCEEDS(umb_vertex_normals_from_faces(&faces, &points, &normal_options, &normal_outputs, &error));
  CHECK(fabs(normals[14] - 1) < 1e-15);
  face_outputs.normal.data = face_normals;
  face_outputs.normal.scalar = UMB_SCALAR_F64;
  SUCCEEDS(umb_face_normals(&faces, &points, &face_options, &face_outputs, &error));
  CHECK(fabs(face_normals[17] + 1) < 1e-15);

  /* The apex: four right-angled isosceles triangles meet in angles of acos(1/3). */
  curvature_options.method = UMB_CURVATURE_ANGLE_DEFECT;
  curvature_outputs.integrated_gaussian.data = numbers;
  curvature_outputs.integrated_gaussian.scalar = UMB_SCALAR_F64;
  SUCCEEDS(umb_curvatures(topology, &points, &curvature_options, &curvature_outputs, &error));
  CHECK(fabs(numbers[4] - (2 * PI - 4 * acos(1.0 / 3))) < 1e-14);
  SUCCEEDS(umb_learn_model(topology, &points, NULL, &model, &error));
  CHECK(model.edge_length > 0);
  section_options.section = UMB_SECTION_CIRCLE;
  section_outputs.curvature.data = numbers;
  section_outputs.curvature.scalar = UMB_SCALAR_F64;
  SUCCEEDS(umb_edge_sections(topology, &points, &section_options, &section_outputs, &error));
  CHECK(isfinite(numbers[17]));
  section_options.directions = points;
  SUCCEEDS(umb_direction_sections(topology, &points, &section_options, &section_outputs, &error));
  polyline_outputs.circle.data = numbers;
  polyline_outputs.circle.scalar = UMB_SCALAR_F64;
  SUCCEEDS(umb_polyline_curvatures(&polyline, &polyline_options, &polyline_outputs, &error));
  CHECK(fabs(numbers[0] - sqrt(0.5)) < 1e-15);
  umb_topology_destroy(topology);

  CHECK(umb_abi_version() == UMB_ABI_VERSION);
  CHECK(umb_version()[0] != '\0' && strstr(umb_build_info(), "umbilic") != NULL);
  CHECK(strcmp(umb_status_string(UMB_ERROR_STRIDE), umb_status_string(UMB_OK)) != 0);
}

/* A struct of a version to come, as long as any may be: what is at its end no version knows. */
enum { LONGEST = 4096 };
#define NEWER(type) \
  union { \
    type known; \
    unsigned char bytes[LONGEST]; \
  }

/* Structs whose size is not set stand for the first version; longer ones must be zero where the library knows nothing. */
static void sizes_of_structs(void) {
  struct mesh mesh = sphere(1, 12, 9);
  umb_topology *topology = topology_of(&mesh, 1);
  umb_points points = points_of(&mesh, UMB_SCALAR_F64);
  struct array old = array_of(mesh.vertex_count, 3, 0, UMB_SCALAR_F64), new = array_of(mesh.vertex_count, 3, 0, UMB_SCALAR_F64);
  umb_normal_options first = {0};
  umb_normal_outputs outputs = {0};
  umb_curvature_outputs curvature_outputs = {0};
  umb_topology_stats no_size = {0};
  static NEWER(umb_normal_options) options;
  static NEWER(umb_normal_outputs) newer_outputs;
  static NEWER(umb_curvature_options) curvature_options;
  static NEWER(umb_topology_stats) stats;

  first.weight = UMB_WEIGHT_ANGLE;
  outputs.normal = output_of(&old);
  SUCCEEDS(umb_vertex_normals(topology, &points, &first, &outputs, &error));
  options.known.struct_size = LONGEST;
  options.known.weight = UMB_WEIGHT_ANGLE;
  newer_outputs.known.struct_size = LONGEST;
  newer_outputs.known.normal = output_of(&new);
  SUCCEEDS(umb_vertex_normals(topology, &points, &options.known, &newer_outputs.known, &error));
  CHECK(memcmp(old.data, new.data, old.bytes) == 0);
  for (size_t byte = LONGEST - 9; byte < LONGEST; byte++) {
    options.bytes[byte] = 1;
    CHECK(umb_vertex_normals(topology, &points, &options.known, &outputs, &error) == UMB_ERROR_UNKNOWN_FIELD);
    CHECK(error.element == byte);
    options.bytes[byte] = 0;
  }
  newer_outputs.bytes[LONGEST - 1] = 1;
  CHECK(umb_vertex_normals(topology, &points, NULL, &newer_outputs.known, &error) == UMB_ERROR_UNKNOWN_FIELD);
  CHECK(error.element == LONGEST - 1);
  curvature_options.known.struct_size = LONGEST;
  SUCCEEDS(umb_curvatures(topology, &points, &curvature_options.known, &curvature_outputs, &error));
  curvature_options.bytes[LONGEST - 2] = 1;
  CHECK(umb_curvatures(topology, &points, &curvature_options.known, &curvature_outputs, &error) == UMB_ERROR_UNKNOWN_FIELD);
  CHECK(error.element == LONGEST - 2);
  options.known.struct_size = LONGEST + 1;
  CHECK(umb_vertex_normals(topology, &points, &options.known, &outputs, &error) == UMB_ERROR_STRUCT_SIZE);
  options.known.struct_size = sizeof first - 1;
  CHECK(umb_vertex_normals(topology, &points, &options.known, &outputs, &error) == UMB_ERROR_STRUCT_SIZE);

  /* What the library writes: what it knows, zeros up to the size that it is given, and nothing beyond. */
  SUCCEEDS(umb_topology_get_stats(topology, &no_size, &error));
  CHECK(no_size.struct_size == 0 && no_size.euler_characteristic == 2);
  memset(stats.bytes, 7, LONGEST);
  stats.known.struct_size = LONGEST - 1;
  SUCCEEDS(umb_topology_get_stats(topology, &stats.known, &error));
  CHECK(stats.known.struct_size == LONGEST - 1 && stats.known.bytes == no_size.bytes);
  CHECK(stats.bytes[LONGEST - 2] == 0 && stats.bytes[LONGEST - 1] == 7);
  memset(stats.bytes, 7, LONGEST);
  stats.known.struct_size = 0;
  SUCCEEDS(umb_topology_get_stats(topology, &stats.known, &error));
  CHECK(stats.known.bytes == no_size.bytes && stats.bytes[sizeof no_size] == 7);

  free(old.data);
  free(new.data);
  umb_topology_destroy(topology);
  mesh_free(&mesh);
}

int main(void) {
  every_function();
  sizes_of_structs();
  puts("old_header: a program of version 0.1.0 runs");
  return 0;
}
