/*
 * Stands in for the library between a program and the real one, which it opens from UMBILIC_REAL, and appends a line to the file
 * UMBILIC_RECORD for every call: what was called, on which handle, with how many threads, what it answered and how many milliseconds
 * it took. So tests see whether handles are freed once and options arrive.
 *
 * With UMBILIC_REPEAT, calls are made a second time on the same arrays, which are warm then; the line ends with what that took.
 *
 * With UMBILIC_SLOW, calls begin a millisecond later, so that others come in between.
 *
 * A struct of the caller's whose size is not set, and a topology that is freed while a call uses it, are defects of a binding, which end
 * the program.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <umbilic.h>

static FILE *record;
static int repeat, slow;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static const umb_topology *in_use[256]; /* a place for each call that is under way */
static uint32_t (*abi_version)(void);
static umb_status (*topology_create)(const umb_faces *, size_t, const umb_topology_options *, umb_topology **, umb_error *);
static void (*topology_destroy)(umb_topology *);
static size_t (*topology_vertex_count)(const umb_topology *);
static umb_status (*vertex_normals)(const umb_topology *, const umb_points *, const umb_normal_options *, const umb_normal_outputs *,
                                    umb_error *);
static umb_status (*curvatures)(const umb_topology *, const umb_points *, const umb_curvature_options *,
                                const umb_curvature_outputs *, umb_error *);

static void fail(const char *what) {
  fprintf(stderr, "recorder: %s\n", what);
  abort();
}

/* POSIX has functions in the void pointers that dlsym answers with; ISO C has no cast for that. */
#define FIND(function) (*(void **)&function = dlsym(real, "umb_" #function), function != NULL ? (void)0 : fail(#function))

__attribute__((constructor)) static void open_real(void) {
  const char *path = getenv("UMBILIC_REAL");
  void *real = path == NULL ? NULL : dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (real == NULL) fail("UMBILIC_REAL is not the library");
  FIND(abi_version);
  FIND(topology_create);
  FIND(topology_destroy);
  FIND(topology_vertex_count);
  FIND(vertex_normals);
  FIND(curvatures);
  path = getenv("UMBILIC_RECORD");
  record = path == NULL ? NULL : fopen(path, "a");
  if (record == NULL) fail("UMBILIC_RECORD cannot be written");
  setvbuf(record, NULL, _IOLBF, 0);
  repeat = getenv("UMBILIC_REPEAT") != NULL;
  slow = getenv("UMBILIC_SLOW") != NULL;
}

/* Nanoseconds: whole numbers are written alike in every locale. */
static long long now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return 1000000000LL * time.tv_sec + time.tv_nsec;
}

static void sized(uint32_t found, size_t expected, const char *what) {
  if (found != expected) fail(what);
}

/* The first place of a topology among those in use, or of null, which is free. */
static const umb_topology **place_of(const umb_topology *topology) {
  for (size_t i = 0; i < sizeof in_use / sizeof in_use[0]; i++) {
    if (in_use[i] == topology) return &in_use[i];
  }
  return NULL;
}

static void begin(const umb_topology *topology) {
  pthread_mutex_lock(&lock);
  const umb_topology **place = place_of(NULL);
  if (place == NULL) fail("too many calls at once");
  *place = topology;
  pthread_mutex_unlock(&lock);
  if (slow) nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
}

static void end(const umb_topology *topology) {
  pthread_mutex_lock(&lock);
  *place_of(topology) = NULL;
  pthread_mutex_unlock(&lock);
}

/* From the start of the call to its end, and on to the end of the second. */
struct times {
  long long start, end, again;
};

static void note(const char *call, const umb_topology *topology, uint32_t threads, umb_status status, struct times times) {
  fprintf(record, "%s %p threads %u status %d ns %lld %lld\n", call, (const void *)topology, (unsigned)threads, (int)status,
          times.end - times.start, times.again - times.end);
}

uint32_t umb_abi_version(void) { return abi_version(); }

size_t umb_topology_vertex_count(const umb_topology *topology) { return topology_vertex_count(topology); }

umb_status umb_topology_create(const umb_faces *faces, size_t vertex_count, const umb_topology_options *options,
                               umb_topology **topology, umb_error *error) {
  sized(error->struct_size, sizeof *error, "umb_error");
  if (options != NULL) sized(options->struct_size, sizeof *options, "umb_topology_options");
  struct times times = {.start = now()};
  umb_status status = topology_create(faces, vertex_count, options, topology, error);
  times.end = times.again = now();
  if (repeat && status == UMB_OK) {
    umb_topology *again = NULL;
    status = topology_create(faces, vertex_count, options, &again, error);
    times.again = now();
    topology_destroy(again);
  }
  note("create", status == UMB_OK ? *topology : NULL, options == NULL ? 0 : options->threads, status, times);
  return status;
}

void umb_topology_destroy(umb_topology *topology) {
  pthread_mutex_lock(&lock);
  if (topology != NULL && place_of(topology) != NULL) fail("a topology is freed while a call uses it");
  pthread_mutex_unlock(&lock);
  note("destroy", topology, 0, UMB_OK, (struct times){0});
  topology_destroy(topology);
}

umb_status umb_vertex_normals(const umb_topology *topology, const umb_points *points, const umb_normal_options *options,
                              const umb_normal_outputs *outputs, umb_error *error) {
  sized(error->struct_size, sizeof *error, "umb_error");
  sized(outputs->struct_size, sizeof *outputs, "umb_normal_outputs");
  if (options != NULL) sized(options->struct_size, sizeof *options, "umb_normal_options");
  begin(topology);
  struct times times = {.start = now()};
  umb_status status = vertex_normals(topology, points, options, outputs, error);
  times.end = now();
  if (repeat) status = vertex_normals(topology, points, options, outputs, error);
  times.again = now();
  note("normals", topology, options == NULL ? 0 : options->run.threads, status, times);
  end(topology);
  return status;
}

umb_status umb_curvatures(const umb_topology *topology, const umb_points *points, const umb_curvature_options *options,
                          const umb_curvature_outputs *outputs, umb_error *error) {
  sized(error->struct_size, sizeof *error, "umb_error");
  sized(outputs->struct_size, sizeof *outputs, "umb_curvature_outputs");
  if (options != NULL) sized(options->struct_size, sizeof *options, "umb_curvature_options");
  begin(topology);
  struct times times = {.start = now()};
  umb_status status = curvatures(topology, points, options, outputs, error);
  times.end = now();
  if (repeat) status = curvatures(topology, points, options, outputs, error);
  times.again = now();
  note("curvature", topology, options == NULL ? 0 : options->run.threads, status, times);
  end(topology);
  return status;
}
