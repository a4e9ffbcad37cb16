/*
 * Eight threads start at a barrier and use one `const` handle at once, each with calls of another kind that themselves use one
 * to three threads; all results are the bytes that a single thread finds. The first argument is the number of rounds. With `apart`
 * as the second, calls use one thread each and none is the first of the process, for helgrind's sake: it only knows the locks of
 * pthread, and takes whatever Rust's guard for a race.
 */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>

#include "library.h"

enum { THREADS = 8, MOST_ROUNDS = 1000 };

static const struct library library = LINKED_LIBRARY;
static pthread_barrier_t start;
static int apart;

struct task {
  const struct mesh *mesh;
  const umb_topology *topology; /* NULL: only calls that need none */
  uint32_t number, rounds;
  pthread_t thread;
  uint64_t found[MOST_ROUNDS];
};

static enum kind kind_of(const struct task *task, uint32_t round) {
  return task->topology != NULL ? (enum kind)((task->number + round) % KIND_COUNT) : WITHOUT_HANDLE;
}

static void *run(void *argument) {
  struct task *task = (struct task *)argument;
  pthread_barrier_wait(&start);
  for (uint32_t round = 0; round < task->rounds; round++) {
    uint32_t threads = apart ? 1 : 1 + (task->number / 2 + round) % 3;
    task->found[round] = work(&library, task->topology, task->mesh, kind_of(task, round), threads);
  }
  return NULL;
}

static void race(const struct mesh *mesh, const umb_topology *topology, uint32_t rounds) {
  static struct task tasks[THREADS];
  uint64_t expected[KIND_COUNT];
  CHECK(pthread_barrier_init(&start, NULL, THREADS) == 0);
  for (uint32_t t = 0; t < THREADS; t++) {
    tasks[t].mesh = mesh;
    tasks[t].topology = topology;
    tasks[t].number = t;
    tasks[t].rounds = rounds;
    CHECK(pthread_create(&tasks[t].thread, NULL, run, &tasks[t]) == 0);
  }
  for (uint32_t t = 0; t < THREADS; t++) CHECK(pthread_join(tasks[t].thread, NULL) == 0);
  pthread_barrier_destroy(&start);
  for (int kind = 0; kind < KIND_COUNT; kind++) {
    if (topology != NULL || kind == WITHOUT_HANDLE) expected[kind] = work(&library, topology, mesh, (enum kind)kind, 1);
  }
  for (uint32_t t = 0; t < THREADS; t++) {
    for (uint32_t round = 0; round < rounds; round++) {
      CHECK(tasks[t].found[round] == expected[kind_of(&tasks[t], round)]);
    }
  }
}

int main(int count, char **arguments) {
  uint32_t rounds = count > 1 ? (uint32_t)strtoul(arguments[1], NULL, 10) : 16;
  struct mesh meshes[] = {sphere(2, 24, 16), torus(24, 18), broken(), torus(70, 31)};
  CHECK(rounds <= MOST_ROUNDS);
  apart = count > 2 && strcmp(arguments[2], "apart") == 0;
  if (apart) work(&library, NULL, &meshes[0], WITHOUT_HANDLE, 1);
  /* The first calls of the process, so that the threads race to whatever is set up once. */
  race(&meshes[0], NULL, 1);
  for (size_t i = 0; i < sizeof meshes / sizeof meshes[0]; i++) {
    umb_topology *topology = topology_of(&meshes[i], 0);
    race(&meshes[i], topology, rounds);
    umb_topology_destroy(topology);
    mesh_free(&meshes[i]);
  }
  puts("threads: the same bytes from eight at once");
  return 0;
}
