/* The arguments that all programs of the benchmarks take:
 *
 *   program MESH TASKS [MEMORY [ROUNDS]]
 *
 * TASKS is the name of a set of tasks, which are timed (rounds.h), or "peak:NAME": then NAME is run once, and what the
 * process had of memory is printed. "peak:nothing" is the program with the mesh alone. */
#ifndef UMBILIC_BENCHES_PROGRAM_H
#define UMBILIC_BENCHES_PROGRAM_H

#include "rounds.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct program {
  bench b;
  mesh m;
  const char *tasks;
  const char *peak; /* what is to be run once, or null */
} program;

/* Sets the memory up and reads the mesh; ends the program if the arguments are not right. */
program start_program(const char *name, int argc, char **argv);
void print_peak(const program *p, double handle_bytes);

#ifdef __cplusplus
}
#endif

#endif
