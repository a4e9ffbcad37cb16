// A check that says where it failed, and holds in every build.
#ifndef CHECK_HPP
#define CHECK_HPP

#include <cstdio>
#include <cstdlib>

#define CHECK(...) \
  do { \
    if (!(__VA_ARGS__)) { \
      std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #__VA_ARGS__); \
      std::exit(EXIT_FAILURE); \
    } \
  } while (0)

#endif
