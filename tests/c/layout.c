/* The layouts that tests/abi.rs asserts from Rust, asserted from C; C11, 64-bit. */
#include "umbilic.h"

#define SIZE(type, size) _Static_assert(sizeof(type) == (size), #type)
#define OFFSET(type, field, offset) _Static_assert(offsetof(type, field) == (offset), #type "." #field)

SIZE(umb_error, 256);
OFFSET(umb_error, struct_size, 0);
OFFSET(umb_error, status, 4);
OFFSET(umb_error, element, 8);
OFFSET(umb_error, message, 16);

SIZE(umb_face_options, 48);
OFFSET(umb_face_options, struct_size, 0);
OFFSET(umb_face_options, reserved, 4);
OFFSET(umb_face_options, run, 8);

SIZE(umb_face_outputs, 72);
OFFSET(umb_face_outputs, struct_size, 0);
OFFSET(umb_face_outputs, reserved, 4);
OFFSET(umb_face_outputs, normal, 8);
OFFSET(umb_face_outputs, area_vector, 32);
OFFSET(umb_face_outputs, status, 56);

SIZE(umb_faces, 40);
OFFSET(umb_faces, indices, 0);
OFFSET(umb_faces, index_count, 8);
OFFSET(umb_faces, offsets, 16);
OFFSET(umb_faces, face_count, 24);
OFFSET(umb_faces, index, 32);
OFFSET(umb_faces, arity, 36);

SIZE(umb_fan, 32);
OFFSET(umb_fan, neighbours, 0);
OFFSET(umb_fan, neighbour_count, 8);
OFFSET(umb_fan, corner_count, 16);
OFFSET(umb_fan, closed, 24);
OFFSET(umb_fan, reserved, 28);

SIZE(umb_normal_options, 56);
OFFSET(umb_normal_options, struct_size, 0);
OFFSET(umb_normal_options, weight, 4);
OFFSET(umb_normal_options, run, 8);
OFFSET(umb_normal_options, degree, 48);
OFFSET(umb_normal_options, rings, 52);

SIZE(umb_normal_outputs, 72);
OFFSET(umb_normal_outputs, struct_size, 0);
OFFSET(umb_normal_outputs, reserved, 4);
OFFSET(umb_normal_outputs, normal, 8);
OFFSET(umb_normal_outputs, sum, 32);
OFFSET(umb_normal_outputs, status, 56);

SIZE(umb_output, 24);
OFFSET(umb_output, data, 0);
OFFSET(umb_output, stride, 8);
OFFSET(umb_output, scalar, 16);
OFFSET(umb_output, reserved, 20);

SIZE(umb_points, 32);
OFFSET(umb_points, data, 0);
OFFSET(umb_points, count, 8);
OFFSET(umb_points, stride, 16);
OFFSET(umb_points, scalar, 24);
OFFSET(umb_points, reserved, 28);

SIZE(umb_polyline, 40);
OFFSET(umb_polyline, data, 0);
OFFSET(umb_polyline, count, 8);
OFFSET(umb_polyline, stride, 16);
OFFSET(umb_polyline, scalar, 24);
OFFSET(umb_polyline, dimension, 28);
OFFSET(umb_polyline, closed, 32);
OFFSET(umb_polyline, reserved, 36);

SIZE(umb_polyline_options, 48);
OFFSET(umb_polyline_options, struct_size, 0);
OFFSET(umb_polyline_options, reserved, 4);
OFFSET(umb_polyline_options, run, 8);

SIZE(umb_polyline_outputs, 120);
OFFSET(umb_polyline_outputs, struct_size, 0);
OFFSET(umb_polyline_outputs, reserved, 4);
OFFSET(umb_polyline_outputs, circle, 8);
OFFSET(umb_polyline_outputs, parabola, 32);
OFFSET(umb_polyline_outputs, length_parabola, 56);
OFFSET(umb_polyline_outputs, symmetric_parabola, 80);
OFFSET(umb_polyline_outputs, status, 104);

SIZE(umb_run, 40);
OFFSET(umb_run, threads, 0);
OFFSET(umb_run, simd, 4);
OFFSET(umb_run, vertices, 8);
OFFSET(umb_run, vertex_count, 16);
OFFSET(umb_run, progress, 24);
OFFSET(umb_run, user, 32);

SIZE(umb_status_output, 16);
OFFSET(umb_status_output, data, 0);
OFFSET(umb_status_output, stride, 8);

SIZE(umb_topology_options, 8);
OFFSET(umb_topology_options, struct_size, 0);
OFFSET(umb_topology_options, reserved, 4);

SIZE(umb_topology_stats, 152);
OFFSET(umb_topology_stats, struct_size, 0);
OFFSET(umb_topology_stats, reserved, 4);
OFFSET(umb_topology_stats, vertex_count, 8);
OFFSET(umb_topology_stats, face_count, 16);
OFFSET(umb_topology_stats, corner_count, 24);
OFFSET(umb_topology_stats, edge_count, 32);
OFFSET(umb_topology_stats, boundary_edges, 40);
OFFSET(umb_topology_stats, non_manifold_edges, 48);
OFFSET(umb_topology_stats, winding_edges, 56);
OFFSET(umb_topology_stats, isolated_vertices, 64);
OFFSET(umb_topology_stats, boundary_vertices, 72);
OFFSET(umb_topology_stats, non_manifold_vertices, 80);
OFFSET(umb_topology_stats, degenerate_faces, 88);
OFFSET(umb_topology_stats, ignored_faces, 96);
OFFSET(umb_topology_stats, duplicate_faces, 104);
OFFSET(umb_topology_stats, component_count, 112);
OFFSET(umb_topology_stats, boundary_loops, 120);
OFFSET(umb_topology_stats, euler_characteristic, 128);
OFFSET(umb_topology_stats, max_valence, 136);
OFFSET(umb_topology_stats, bytes, 144);

int main(void) { return 0; }
