/* The layouts that tests/abi.rs asserts from Rust, asserted from C; C11, 64-bit. */
#include "umbilic.h"

#define SIZE(type, size) _Static_assert(sizeof(type) == (size), #type)
#define OFFSET(type, field, offset) _Static_assert(offsetof(type, field) == (offset), #type "." #field)

SIZE(umb_adaptive_model, 88);
OFFSET(umb_adaptive_model, struct_size, 0);
OFFSET(umb_adaptive_model, coordinates, 4);
OFFSET(umb_adaptive_model, edge_length, 8);
OFFSET(umb_adaptive_model, noise, 16);
OFFSET(umb_adaptive_model, sizes, 24);
OFFSET(umb_adaptive_model, noise_exponent, 56);
OFFSET(umb_adaptive_model, size_exponent, 60);
OFFSET(umb_adaptive_model, evidence, 64);
OFFSET(umb_adaptive_model, sample, 80);
OFFSET(umb_adaptive_model, reserved, 84);

SIZE(umb_bytes, 24);
OFFSET(umb_bytes, data, 0);
OFFSET(umb_bytes, count, 8);
OFFSET(umb_bytes, stride, 16);

SIZE(umb_corner_outputs, 96);
OFFSET(umb_corner_outputs, struct_size, 0);
OFFSET(umb_corner_outputs, reserved, 4);
OFFSET(umb_corner_outputs, corner, 8);
OFFSET(umb_corner_outputs, normal, 32);
OFFSET(umb_corner_outputs, sum, 56);
OFFSET(umb_corner_outputs, status, 80);

SIZE(umb_creases, 48);
OFFSET(umb_creases, struct_size, 0);
OFFSET(umb_creases, reserved, 4);
OFFSET(umb_creases, angle, 8);
OFFSET(umb_creases, edges, 16);
OFFSET(umb_creases, edge_count, 24);
OFFSET(umb_creases, groups, 32);
OFFSET(umb_creases, group_count, 40);

SIZE(umb_curvature_options, 120);
OFFSET(umb_curvature_options, struct_size, 0);
OFFSET(umb_curvature_options, method, 4);
OFFSET(umb_curvature_options, section, 8);
OFFSET(umb_curvature_options, weight, 12);
OFFSET(umb_curvature_options, radius, 16);
OFFSET(umb_curvature_options, degree, 24);
OFFSET(umb_curvature_options, rings, 28);
OFFSET(umb_curvature_options, normal_degree, 32);
OFFSET(umb_curvature_options, normal_rings, 36);
OFFSET(umb_curvature_options, model, 40);
OFFSET(umb_curvature_options, normals, 48);
OFFSET(umb_curvature_options, run, 80);

SIZE(umb_curvature_outputs, 408);
OFFSET(umb_curvature_outputs, struct_size, 0);
OFFSET(umb_curvature_outputs, reserved, 4);
OFFSET(umb_curvature_outputs, k1, 8);
OFFSET(umb_curvature_outputs, k2, 32);
OFFSET(umb_curvature_outputs, direction1, 56);
OFFSET(umb_curvature_outputs, direction2, 80);
OFFSET(umb_curvature_outputs, mean, 104);
OFFSET(umb_curvature_outputs, gaussian, 128);
OFFSET(umb_curvature_outputs, mean_normal, 152);
OFFSET(umb_curvature_outputs, area, 176);
OFFSET(umb_curvature_outputs, integrated_mean, 200);
OFFSET(umb_curvature_outputs, integrated_gaussian, 224);
OFFSET(umb_curvature_outputs, shape_index, 248);
OFFSET(umb_curvature_outputs, curvedness, 272);
OFFSET(umb_curvature_outputs, residual, 296);
OFFSET(umb_curvature_outputs, condition, 320);
OFFSET(umb_curvature_outputs, degrees_of_freedom, 344);
OFFSET(umb_curvature_outputs, normal, 368);
OFFSET(umb_curvature_outputs, status, 392);

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

SIZE(umb_feature_options, 56);
OFFSET(umb_feature_options, struct_size, 0);
OFFSET(umb_feature_options, reserved, 4);
OFFSET(umb_feature_options, creases, 8);
OFFSET(umb_feature_options, run, 16);

SIZE(umb_moved, 48);
OFFSET(umb_moved, struct_size, 0);
OFFSET(umb_moved, reserved, 4);
OFFSET(umb_moved, vertices, 8);
OFFSET(umb_moved, vertex_count, 16);
OFFSET(umb_moved, status, 24);

SIZE(umb_normal_options, 64);
OFFSET(umb_normal_options, struct_size, 0);
OFFSET(umb_normal_options, weight, 4);
OFFSET(umb_normal_options, run, 8);
OFFSET(umb_normal_options, degree, 48);
OFFSET(umb_normal_options, rings, 52);
OFFSET(umb_normal_options, model, 56);

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

SIZE(umb_region_options, 112);
OFFSET(umb_region_options, struct_size, 0);
OFFSET(umb_region_options, reserved, 4);
OFFSET(umb_region_options, smallest_share, 8);
OFFSET(umb_region_options, tolerance, 16);
OFFSET(umb_region_options, smallest_faces, 24);
OFFSET(umb_region_options, creases, 32);
OFFSET(umb_region_options, classes, 40);
OFFSET(umb_region_options, curvature, 64);
OFFSET(umb_region_options, run, 72);

SIZE(umb_run, 40);
OFFSET(umb_run, threads, 0);
OFFSET(umb_run, simd, 4);
OFFSET(umb_run, vertices, 8);
OFFSET(umb_run, vertex_count, 16);
OFFSET(umb_run, progress, 24);
OFFSET(umb_run, user, 32);

SIZE(umb_scalars, 32);
OFFSET(umb_scalars, data, 0);
OFFSET(umb_scalars, count, 8);
OFFSET(umb_scalars, stride, 16);
OFFSET(umb_scalars, scalar, 24);
OFFSET(umb_scalars, location, 28);

SIZE(umb_section_options, 136);
OFFSET(umb_section_options, struct_size, 0);
OFFSET(umb_section_options, section, 4);
OFFSET(umb_section_options, weight, 8);
OFFSET(umb_section_options, shared, 12);
OFFSET(umb_section_options, normals, 16);
OFFSET(umb_section_options, directions, 48);
OFFSET(umb_section_options, normal_degree, 80);
OFFSET(umb_section_options, normal_rings, 84);
OFFSET(umb_section_options, model, 88);
OFFSET(umb_section_options, run, 96);

SIZE(umb_section_outputs, 72);
OFFSET(umb_section_outputs, struct_size, 0);
OFFSET(umb_section_outputs, reserved, 4);
OFFSET(umb_section_outputs, curvature, 8);
OFFSET(umb_section_outputs, status, 32);
OFFSET(umb_section_outputs, normal, 48);

SIZE(umb_shape_options, 88);
OFFSET(umb_shape_options, struct_size, 0);
OFFSET(umb_shape_options, reserved, 4);
OFFSET(umb_shape_options, tolerance, 8);
OFFSET(umb_shape_options, points, 16);
OFFSET(umb_shape_options, status, 24);
OFFSET(umb_shape_options, run, 48);

SIZE(umb_status_output, 16);
OFFSET(umb_status_output, data, 0);
OFFSET(umb_status_output, stride, 8);

SIZE(umb_topology_options, 16);
OFFSET(umb_topology_options, struct_size, 0);
OFFSET(umb_topology_options, threads, 4);
OFFSET(umb_topology_options, simd, 8);
OFFSET(umb_topology_options, reserved, 12);

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

SIZE(umb_watershed_options, 72);
OFFSET(umb_watershed_options, struct_size, 0);
OFFSET(umb_watershed_options, reserved, 4);
OFFSET(umb_watershed_options, depth, 8);
OFFSET(umb_watershed_options, height, 16);
OFFSET(umb_watershed_options, curvature, 24);
OFFSET(umb_watershed_options, run, 32);
