/*
 * Faults on purpose, one a run, which a sanitizer must catch: so that a run without findings means something. Those that start
 * with `library` happen inside the library's code, and prove that it is instrumented as well. The argument is the fault.
 */
#define _POSIX_C_SOURCE 200809L
#include <limits.h>
#include <pthread.h>

#include "mesh.h"

/* The compiler must not see through the faults. */
static volatile size_t past_the_end = 8;
static volatile int largest = INT_MAX;
static char *volatile lost;

static struct mesh mesh;
static int counter;

static void overflow(void) {
  char *block = (char *)memory(8);
  block[past_the_end] = 1;
  free(block);
}

static void normals_into(double *normals) {
  umb_error error = UMB_ERROR_INIT;
  umb_topology *topology = topology_of(&mesh, 1);
  umb_points points = points_of(&mesh, UMB_SCALAR_F64);
  umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
  umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT;
  options.run.threads = 1;
  outputs.normal.data = normals;
  outputs.normal.scalar = UMB_SCALAR_F64;
  SUCCEEDS(umb_vertex_normals(topology, &points, &options, &outputs, &error));
  umb_topology_destroy(topology);
}

/* Room for all vertices but one. */
static void library_overflow(void) {
  double *normals = (double *)memory((mesh.vertex_count - 1) * 3 * sizeof *normals);
  normals_into(normals);
  free(normals);
}

static void leak(void) {
  lost = (char *)memory(100);
  lost = NULL;
}

/* A handle that is never destroyed: memory that the library allocated. */
static void library_leak(void) {
  lost = (char *)topology_of(&mesh, 1);
  lost = NULL;
}

static void undefined(void) { CHECK(largest + 1 != 0); }

static void uninitialised(void) {
  lost = (char *)malloc(sizeof(int));
  int *number = (int *)(void *)lost;
  CHECK(number != NULL);
  if (*number == 12345) puts("as it happens");
  free(number);
}

/* Positions that were never written: whether they are finite decides a branch in the library. */
static void library_uninitialised(void) {
  double *normals = (double *)memory(mesh.vertex_count * 3 * sizeof *normals);
  free(mesh.positions);
  mesh.positions = (double *)malloc(mesh.vertex_count * 3 * sizeof *mesh.positions);
  CHECK(mesh.positions != NULL);
  normals_into(normals);
  free(normals);
}

static void *count_up(void *argument) {
  (void)argument;
  for (int i = 0; i < 100000; i++) counter++;
  return NULL;
}

static void *move_positions(void *argument) {
  volatile double *positions = mesh.positions;
  (void)argument;
  for (int round = 0; round < 2000; round++) {
    for (size_t i = 0; i < 3 * mesh.vertex_count; i++) positions[i] = positions[i] + 1e-9;
  }
  return NULL;
}

static void with_thread(void *(*other)(void *), void (*own)(void)) {
  pthread_t thread;
  CHECK(pthread_create(&thread, NULL, other, NULL) == 0);
  own();
  CHECK(pthread_join(thread, NULL) == 0);
}

static void count_up_too(void) { count_up(NULL); }

/* Reads the positions that the other thread moves. */
static void many_normals(void) {
  double *normals = (double *)memory(mesh.vertex_count * 3 * sizeof *normals);
  for (int round = 0; round < 100; round++) normals_into(normals);
  free(normals);
}

int main(int count, char **arguments) {
  const char *fault = count > 1 ? arguments[1] : "none";
  mesh = sphere(2, 24, 16);
  if (strcmp(fault, "overflow") == 0) overflow();
  if (strcmp(fault, "library-overflow") == 0) library_overflow();
  if (strcmp(fault, "leak") == 0) leak();
  if (strcmp(fault, "library-leak") == 0) library_leak();
  if (strcmp(fault, "undefined") == 0) undefined();
  if (strcmp(fault, "uninitialised") == 0) uninitialised();
  if (strcmp(fault, "library-uninitialised") == 0) library_uninitialised();
  if (strcmp(fault, "race") == 0) with_thread(count_up, count_up_too);
  if (strcmp(fault, "library-race") == 0) with_thread(move_positions, many_normals);
  mesh_free(&mesh);
  return 0;
}
