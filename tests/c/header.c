/* Compiles as C99 to C17 and C++11 to C++20 without a warning, and uses every initialiser. */
#include "umbilic.h"

static umb_status call_everything(const umb_faces *faces, const umb_points *points) {
  umb_error error = UMB_ERROR_INIT;
  umb_topology_options topology_options = UMB_TOPOLOGY_OPTIONS_INIT;
  umb_topology_stats stats = UMB_TOPOLOGY_STATS_INIT;
  umb_normal_options normal_options = UMB_NORMAL_OPTIONS_INIT;
  umb_normal_outputs normal_outputs = UMB_NORMAL_OUTPUTS_INIT;
  umb_face_options face_options = UMB_FACE_OPTIONS_INIT;
  umb_face_outputs face_outputs = UMB_FACE_OUTPUTS_INIT;
  umb_adaptive_model model = UMB_ADAPTIVE_MODEL_INIT;
  umb_curvature_options curvature_options = UMB_CURVATURE_OPTIONS_INIT;
  umb_curvature_outputs curvature_outputs = UMB_CURVATURE_OUTPUTS_INIT;
  umb_section_options section_options = UMB_SECTION_OPTIONS_INIT;
  umb_section_outputs section_outputs = UMB_SECTION_OUTPUTS_INIT;
  umb_polyline polyline = {points->data, points->count, points->stride, points->scalar, 3, 1, 0};
  umb_polyline_options polyline_options = UMB_POLYLINE_OPTIONS_INIT;
  umb_polyline_outputs polyline_outputs = UMB_POLYLINE_OUTPUTS_INIT;
  umb_topology *topology = NULL;
  umb_status status = umb_topology_create(faces, points->count, &topology_options, &topology, &error);
  if (status == UMB_OK) status = umb_topology_get_stats(topology, &stats, &error);
  if (status == UMB_OK) status = umb_vertex_normals(topology, points, &normal_options, &normal_outputs, &error);
  if (status == UMB_OK) status = umb_vertex_normals_from_faces(faces, points, &normal_options, &normal_outputs, &error);
  if (status == UMB_OK) status = umb_face_normals(faces, points, &face_options, &face_outputs, &error);
  if (status == UMB_OK) status = umb_learn_model(topology, points, &normal_options, &model, &error);
  if (status == UMB_OK) status = umb_curvatures(topology, points, &curvature_options, &curvature_outputs, &error);
  if (status == UMB_OK) status = umb_edge_sections(topology, points, &section_options, &section_outputs, &error);
  section_options.directions = *points;
  if (status == UMB_OK) status = umb_direction_sections(topology, points, &section_options, &section_outputs, &error);
  if (status == UMB_OK) status = umb_polyline_curvatures(&polyline, &polyline_options, &polyline_outputs, &error);
  if (status == UMB_OK && stats.vertex_count != umb_topology_vertex_count(topology)) status = UMB_ERROR_INTERNAL;
  if (status == UMB_OK && stats.face_count != umb_topology_face_count(topology)) status = UMB_ERROR_INTERNAL;
  umb_topology_destroy(topology);
  return status;
}

int main(void) {
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const uint32_t triangle[3] = {0, 1, 2};
  umb_faces faces = {triangle, 3, NULL, 1, UMB_INDEX_U32, 3};
  umb_points points = {corners, 3, 0, UMB_SCALAR_F32, 0};
  if (umb_abi_version() != UMB_ABI_VERSION) return 2;
  return call_everything(&faces, &points) == UMB_OK ? 0 : 1;
}
