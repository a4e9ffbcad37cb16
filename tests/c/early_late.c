/*
 * The library before `main` begins and while the process ends: in a constructor, in the destructor of a thread's own data, in an
 * exit handler and in a destructor; with threads of its own in each.
 */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>

#include "library.h"

static const struct library library = LINKED_LIBRARY;
static uint64_t expected;
static int places;

/* The same work everywhere, on a mesh of its own since not even main's data are there everywhere. */
static void use(const char *place) {
  struct mesh mesh = torus(70, 31);
  uint64_t found = all_work(&library, &mesh, 3);
  mesh_free(&mesh);
  CHECK(expected == 0 || found == expected);
  expected = found;
  places++;
  printf("early_late: %s\n", place);
}

/* The numbers are priorities: early among constructors, and late among destructors. */
__attribute__((constructor(101))) static void before_main(void) { use("before main"); }

__attribute__((destructor(101))) static void last(void) {
  use("in a destructor");
  if (places != 6) _Exit(EXIT_FAILURE);
}

static void at_exit(void) { use("in an exit handler"); }

static pthread_key_t key;

static void end_of_thread(void *data) {
  (void)data;
  use("at the end of a thread");
}

static void *run(void *data) {
  CHECK(pthread_setspecific(key, data) == 0);
  use("in a thread");
  return NULL;
}

int main(void) {
  pthread_t thread;
  CHECK(atexit(at_exit) == 0);
  use("in main");
  CHECK(pthread_key_create(&key, end_of_thread) == 0);
  CHECK(pthread_create(&thread, NULL, run, &key) == 0);
  CHECK(pthread_join(thread, NULL) == 0);
  return 0;
}
