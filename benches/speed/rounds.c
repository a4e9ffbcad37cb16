#define _POSIX_C_SOURCE 200809L
#include "rounds.h"

#include "scatter.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static const double LONG_ENOUGH = 0.003; /* seconds */

/* Seconds, by both clocks. */
typedef struct moment {
  double wall, cpu;
} moment;

static double read_clock(clockid_t clock) {
  struct timespec t;
  clock_gettime(clock, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static moment now(void) {
  return (moment){read_clock(CLOCK_MONOTONIC), read_clock(CLOCK_PROCESS_CPUTIME_ID)};
}

typedef struct scatter_context {
  const mesh *m;
  float *normals;
} scatter_context;

static void run_scatter(void *context) {
  scatter_context *c = context;
  scatter_area(c->m, c->normals);
}

/* Seconds of one run, as the mean of so many. */
static moment time_runs(void (*run)(void *), void *context, int repeats) {
  moment start = now();
  for (int i = 0; i < repeats; i++) run(context);
  moment end = now();
  return (moment){(end.wall - start.wall) / repeats, (end.cpu - start.cpu) / repeats};
}

/* Warms something up, and tells how often it is to be run. */
static int repeats_of(void (*run)(void *), void *context) {
  double seconds = time_runs(run, context, 1).wall;
  if (seconds < 10 * LONG_ENOUGH) seconds = time_runs(run, context, 1).wall;
  return seconds * 1000 > LONG_ENOUGH ? (int)ceil(LONG_ENOUGH / seconds) : 1000;
}

static void print_samples(const char *key, const moment *samples, int count, double scale) {
  for (int cpu = 0; cpu < 2; cpu++) {
    printf(", \"%s%s\": [", cpu ? "cpu_" : "", key);
    for (int i = 0; i < count; i++) printf("%s%.4g", i ? ", " : "", scale * (cpu ? samples[i].cpu : samples[i].wall));
    printf("]");
  }
}

static void print_task(const bench *b, const mesh *m, const task *t, const moment *samples, const moment *scatter) {
  double ns = 1e9 / (double)m->triangle_count;
  printf("{\"program\": \"%s\", \"mesh\": \"%s\", \"memory\": \"%s\"", b->program, b->mesh_name, b->memory);
  printf(", \"library\": \"%s\", \"name\": \"%s\", \"scalar\": \"%s\"", t->library, t->name, t->scalar);
  printf(", \"level\": \"%s\", \"threads\": %d, \"triangles\": %zu", t->level, t->threads, m->triangle_count);
  print_samples("ns", samples, b->rounds, ns / t->share);
  print_samples("scatter", scatter, b->rounds, ns);
  printf("}\n");
}

void time_tasks(const bench *b, const mesh *m, const task *tasks, size_t count) {
  size_t rounds = (size_t)b->rounds;
  moment *samples = allocate(count * rounds * sizeof *samples), *scatter = allocate(count * rounds * sizeof *scatter);
  int *repeats = allocate(count * sizeof *repeats);
  scatter_context context = {m, allocate(m->vertex_count * 3 * sizeof(float))};
  int scatter_repeats = repeats_of(run_scatter, &context);
  for (size_t t = 0; t < count; t++) repeats[t] = repeats_of(tasks[t].run, tasks[t].context);
  for (size_t r = 0; r < rounds; r++)
    for (size_t t = 0; t < count; t++) {
      scatter[t * rounds + r] = time_runs(run_scatter, &context, scatter_repeats);
      samples[t * rounds + r] = time_runs(tasks[t].run, tasks[t].context, repeats[t]);
    }
  for (size_t t = 0; t < count; t++) print_task(b, m, &tasks[t], samples + t * rounds, scatter + t * rounds);
  free(context.normals);
  free(samples);
  free(scatter);
  free(repeats);
}
