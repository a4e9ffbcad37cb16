/* What the C programs of this folder share: a check that says where it failed, and memory that is there. */
#ifndef CHECK_H
#define CHECK_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Not assert(): it must hold in every build. */
#define CHECK(condition) \
  do { \
    if (!(condition)) { \
      fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
      exit(EXIT_FAILURE); \
    } \
  } while (0)

/* A call that must succeed; its error is called `error`. */
#define SUCCEEDS(call) \
  do { \
    umb_status succeeds_ = (call); \
    if (succeeds_ != UMB_OK) { \
      fprintf(stderr, "%s:%d: status %d, %s\n", __FILE__, __LINE__, (int)succeeds_, error.message); \
      exit(EXIT_FAILURE); \
    } \
  } while (0)

/* Exactly so many bytes of the heap, so that a sanitizer sees the first byte beyond them; filled with a pattern. */
static inline void *memory(size_t bytes) {
  void *block = malloc(bytes > 0 ? bytes : 1);
  CHECK(block != NULL);
  memset(block, 0x5a, bytes);
  return block;
}

/* Goes on with the hash of Fowler, Noll and Vo: equal bytes give equal numbers. */
static inline uint64_t hash_bytes(uint64_t hash, const void *data, size_t bytes) {
  const unsigned char *byte = (const unsigned char *)data;
  for (size_t i = 0; i < bytes; i++) hash = (hash ^ byte[i]) * UINT64_C(1099511628211);
  return hash;
}

#define HASH_START UINT64_C(14695981039346656037)

#endif
