// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checks that say where they failed, and go on.
#ifndef UMBILIC_MESHLAB_TESTS_CHECK_H
#define UMBILIC_MESHLAB_TESTS_CHECK_H

#include <cstdio>

inline int checks_done = 0;
inline int checks_failed = 0;

#define CHECK(condition, ...)                                       \
  do {                                                              \
    checks_done++;                                                  \
    if (!(condition)) {                                             \
      checks_failed++;                                              \
      std::fprintf(stderr, "%s:%d: %s: ", __FILE__, __LINE__, #condition); \
      std::fprintf(stderr, __VA_ARGS__);                            \
      std::fprintf(stderr, "\n");                                   \
    }                                                               \
  } while (false)

/** What `main` returns. */
inline int outcome(const char *program) {
  std::printf("%s: %d checks, %d failed\n", program, checks_done, checks_failed);
  return checks_failed == 0 ? 0 : 1;
}

#endif  // UMBILIC_MESHLAB_TESTS_CHECK_H
