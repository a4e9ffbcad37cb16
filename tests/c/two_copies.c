/*
 * Several copies of the library in one process: the static library in this program, and each shared library that is named on
 * the command line. They are used in turn and from a thread each, give the same bytes, and do not call into each other.
 */
#define _GNU_SOURCE /* dladdr */
#include <pthread.h>

#include "library.h"

enum { MOST_COPIES = 8 };

static const struct library linked = LINKED_LIBRARY;
static struct mesh mesh;

struct copy {
  struct library library;
  uint64_t found;
  pthread_t thread;
};

/* The file that an address belongs to. */
static const char *file_of(const void *address) {
  Dl_info info;
  CHECK(dladdr(address, &info) != 0);
  return info.dli_fname;
}

static void *run(void *argument) {
  struct copy *copy = (struct copy *)argument;
  uint64_t first = copy->found;
  for (uint32_t round = 0; round < 4; round++) {
    copy->found = all_work(&copy->library, &mesh, 1 + round % 3);
    CHECK(copy->found == first);
  }
  return NULL;
}

int main(int count, char **arguments) {
  static struct copy copies[MOST_COPIES];
  size_t copy_count = (size_t)count;
  CHECK(count > 1 && count <= MOST_COPIES);
  mesh = torus(70, 31);
  copies[0].library = linked;
  for (size_t i = 1; i < copy_count; i++) {
    void *handle = dlopen(arguments[i], RTLD_NOW | RTLD_LOCAL);
    if (handle == NULL) fprintf(stderr, "%s\n", dlerror());
    CHECK(handle != NULL);
    copies[i].library = library_of(handle);
  }
  for (size_t i = 0; i < copy_count; i++) {
    /* The text is in the copy that was asked, so the code that answered is, too. */
    const char *file = file_of(copies[i].library.umb_version());
    CHECK(i == 0 || strcmp(file, arguments[i]) == 0);
    for (size_t j = 0; j < i; j++) {
      CHECK(copies[i].library.umb_vertex_normals != copies[j].library.umb_vertex_normals);
      CHECK(copies[i].library.umb_version() != copies[j].library.umb_version());
    }
  }
  for (uint32_t round = 0; round < 3; round++) {
    for (size_t i = 0; i < copy_count; i++) {
      copies[i].found = all_work(&copies[i].library, &mesh, 1 + round);
      CHECK(copies[i].found == copies[0].found);
    }
  }
  for (size_t i = 0; i < copy_count; i++) CHECK(pthread_create(&copies[i].thread, NULL, run, &copies[i]) == 0);
  for (size_t i = 0; i < copy_count; i++) CHECK(pthread_join(copies[i].thread, NULL) == 0);
  mesh_free(&mesh);
  printf("two_copies: %d copies side by side\n", count);
  return 0;
}
