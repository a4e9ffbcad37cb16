/* Times tasks in turns with the scatter kernel, in one process.
 *
 * In every round the kernel runs before every task, so that the two share whatever the machine does meanwhile; what is
 * short is repeated until it takes some milliseconds. Wall time, by a monotonic clock, and the CPU time of the process. A
 * first round, which is not counted, warms up. */
#ifndef UMBILIC_BENCHES_ROUNDS_H
#define UMBILIC_BENCHES_ROUNDS_H

#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct task {
  const char *library, *name, *scalar, *level;
  int threads;
  double share; /* of the mesh's vertices that are computed; 1 for all */
  void (*run)(void *context);
  void *context;
} task;

typedef struct bench {
  const char *program, *mesh_name, *memory;
  int rounds;
} bench;

/* Prints one line of JSON for each task: what it is, and of each round the nanoseconds a triangle of the task and of the
 * scatter kernel, by both clocks. */
void time_tasks(const bench *b, const mesh *m, const task *tasks, size_t count);

#ifdef __cplusplus
}
#endif

#endif
