/* The layouts that tests/abi.rs asserts from Rust, asserted from C; C11, 64-bit. */
#include "umbilic.h"

#define SIZE(type, size) _Static_assert(sizeof(type) == (size), #type)
#define OFFSET(type, field, offset) _Static_assert(offsetof(type, field) == (offset), #type "." #field)

SIZE(umb_points, 32);
SIZE(umb_faces, 40);
SIZE(umb_output, 24);
SIZE(umb_status_output, 16);
SIZE(umb_run, 40);
SIZE(umb_fan, 32);
SIZE(umb_error, 256);
SIZE(umb_topology_stats, 152);
SIZE(umb_topology_options, 8);
SIZE(umb_normal_options, 48);
SIZE(umb_normal_outputs, 72);
SIZE(umb_face_options, 48);
SIZE(umb_face_outputs, 72);
OFFSET(umb_points, stride, 16);
OFFSET(umb_points, scalar, 24);
OFFSET(umb_faces, offsets, 16);
OFFSET(umb_faces, index, 32);
OFFSET(umb_faces, arity, 36);
OFFSET(umb_run, vertices, 8);
OFFSET(umb_run, progress, 24);
OFFSET(umb_run, user, 32);
OFFSET(umb_error, element, 8);
OFFSET(umb_error, message, 16);
OFFSET(umb_normal_options, weight, 4);
OFFSET(umb_normal_options, run, 8);
OFFSET(umb_normal_outputs, normal, 8);
OFFSET(umb_normal_outputs, sum, 32);
OFFSET(umb_normal_outputs, status, 56);
OFFSET(umb_fan, corner_count, 16);
OFFSET(umb_fan, closed, 24);
OFFSET(umb_topology_stats, euler_characteristic, 128);
OFFSET(umb_topology_stats, bytes, 144);

int main(void) { return 0; }
