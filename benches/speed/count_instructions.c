/* Runs one of umbilic's variants some times on one thread, for valgrind to count what it takes.
 *
 *   count_instructions MESH NAME f32|f64 LEVEL TIMES     LEVEL: 1 portable, 3 AVX2 */
#include "ours.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv) {
  if (argc != 6) {
    fprintf(stderr, "usage: %s MESH NAME f32|f64 LEVEL TIMES\n", argv[0]);
    return 2;
  }
  mesh m = read_mesh(argv[1]);
  ours *o = ours_new(&m, 0);
  umb_scalar scalar = strcmp(argv[3], "f64") ? UMB_SCALAR_F32 : UMB_SCALAR_F64;
  for (int times = atoi(argv[5]); times > 0; times--) ours_run(o, argv[2], scalar, 1, (umb_simd)atoi(argv[4]));
  printf("%zu\n", m.triangle_count);
  ours_free(o);
  free_mesh(&m);
  return 0;
}
