/*
 * Opens the library, uses it with threads, and closes it, a thousand times; then from four threads at once. Neither memory nor
 * files nor threads may pile up. The first argument is the library, the second the number of rounds; the third is `stays` or
 * `goes`: whether the library, whose shared form asks not to be unmapped, is still there after it was closed.
 */
#define _POSIX_C_SOURCE 200809L
#include <dirent.h>
#include <pthread.h>
#include <time.h>

#include "library.h"

enum { THREADS = 4 };

static const char *path;
static struct mesh mesh;
static uint64_t expected[KIND_COUNT];

/* How many entries a directory of /proc has. */
static size_t entries(const char *directory) {
  DIR *open = opendir(directory);
  size_t count = 0;
  CHECK(open != NULL);
  while (readdir(open) != NULL) count++;
  closedir(open);
  return count;
}

/* Whether so many threads are left: one that was waited for may still be seen for a moment. */
static int threads_are(size_t wanted) {
  for (int attempt = 0; attempt < 1000; attempt++) {
    const struct timespec moment = {0, 1000000};
    if (entries("/proc/self/task") == wanted) return 1;
    nanosleep(&moment, NULL);
  }
  return 0;
}

/* A line of numbers of this process, in kilobytes. */
static long status_of(const char *name) {
  char line[256];
  long found = -1;
  FILE *status = fopen("/proc/self/status", "r");
  CHECK(status != NULL);
  while (fgets(line, sizeof line, status) != NULL) {
    if (strncmp(line, name, strlen(name)) == 0) found = strtol(line + strlen(name), NULL, 10);
  }
  fclose(status);
  CHECK(found >= 0);
  return found;
}

/* Opens, works, closes: all kinds of work take turns. */
static uint64_t round_trip(uint32_t round, uint32_t threads) {
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(&mesh);
  umb_topology_options options = UMB_TOPOLOGY_OPTIONS_INIT;
  umb_topology *topology = NULL;
  void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (handle == NULL) fprintf(stderr, "%s\n", dlerror());
  CHECK(handle != NULL);
  struct library library = library_of(handle);
  options.threads = threads;
  SUCCEEDS(library.umb_topology_create(&faces, mesh.vertex_count, &options, &topology, &error));
  uint64_t found = work(&library, topology, &mesh, (enum kind)(round % KIND_COUNT), threads);
  library.umb_topology_destroy(topology);
  CHECK(dlclose(handle) == 0);
  return found;
}

/* Closes while others use it, and ends after it was closed. */
static void *run(void *argument) {
  uint32_t rounds = *(const uint32_t *)argument;
  for (uint32_t round = 0; round < rounds; round++) {
    CHECK(round_trip(round, 1 + round % 3) == expected[round % KIND_COUNT]);
  }
  return NULL;
}

int main(int count, char **arguments) {
  CHECK(count > 1);
  uint32_t rounds = count > 2 ? (uint32_t)strtoul(arguments[2], NULL, 10) : 1000;
  path = arguments[1];
  mesh = torus(70, 31); /* enough vertices for a second thread */
  for (uint32_t round = 0; round < rounds / 10 + KIND_COUNT; round++) {
    expected[round % KIND_COUNT] = round_trip(round, 1 + round % 3);
  }
  long memory_before = status_of("VmRSS:"), mapped_before = status_of("VmSize:");
  size_t files = entries("/proc/self/fd"), threads = entries("/proc/self/task");
  for (uint32_t round = 0; round < rounds; round++) CHECK(round_trip(round, 3) == expected[round % KIND_COUNT]);
  long memory_after = status_of("VmRSS:"), mapped_after = status_of("VmSize:");
  printf("reload: memory grew by %ld kB, address space by %ld kB\n", memory_after - memory_before, mapped_after - mapped_before);
  if (count > 3) {
    void *still_there = dlopen(path, RTLD_NOW | RTLD_NOLOAD);
    CHECK((still_there != NULL) == (strcmp(arguments[3], "stays") == 0));
    if (still_there != NULL) CHECK(dlclose(still_there) == 0);
  }
  /* Room for what the C library keeps for itself, such as an arena of 64 MB of addresses for a thread. The handles of all rounds would
     be 100 MB, and the stack of a thread left behind in every round 2 GB. */
  CHECK(memory_after - memory_before < 8 * 1024 && mapped_after - mapped_before < 512 * 1024);
  CHECK(entries("/proc/self/fd") == files && threads_are(threads));

  pthread_t thread[THREADS];
  uint32_t share = rounds / THREADS;
  for (int t = 0; t < THREADS; t++) CHECK(pthread_create(&thread[t], NULL, run, &share) == 0);
  for (int t = 0; t < THREADS; t++) CHECK(pthread_join(thread[t], NULL) == 0);
  CHECK(entries("/proc/self/fd") == files && threads_are(threads));
  mesh_free(&mesh);
  printf("reload: %u rounds, and as many from four threads\n", (unsigned)rounds);
  return 0;
}
