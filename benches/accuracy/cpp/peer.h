// A library that is compared with, as a program: meshes come in on standard input, results leave on standard output,
// until the input ends. All numbers are little-endian, as the machine has them.
//
// In:  int64 methods (bit 0 for the first), vertices, triangles, quads; double positions[vertices][3];
//      int32 triangles[][3], quads[][4]
// Out: for each method that is wanted, in the order that `--list` prints behind the library's name and version:
//      double seconds of CPU time; then its results, vertex after vertex: a normal (3 doubles), k1 and k2 (2), or all 5
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

namespace peer {

struct Input {
  std::vector<double> positions;
  std::vector<std::int32_t> triangles, quads;

  std::size_t vertices() const { return positions.size() / 3; }

  // Calls with the number of corners and the first corner of each face.
  template <class Visit>
  void faces(Visit visit) const {
    for (std::size_t corner = 0; corner < quads.size(); corner += 4) {
      visit(4, &quads[corner]);
    }
    for (std::size_t corner = 0; corner < triangles.size(); corner += 3) {
      visit(3, &triangles[corner]);
    }
  }
};

// A method of a library, which writes `width()` doubles a vertex: `results` is "normal", "curvature" or "both".
struct Method {
  std::string name, results;
  std::function<void(double *)> run;

  std::size_t width() const { return results == "normal" ? 3 : results == "curvature" ? 2 : 5; }
};

inline void must(bool done) {
  if (!done) {
    std::exit(EXIT_FAILURE);
  }
}

template <class Number>
void read(std::vector<Number> &numbers, std::int64_t count) {
  numbers.resize(static_cast<std::size_t>(count));
  must(std::fread(numbers.data(), sizeof(Number), numbers.size(), stdin) == numbers.size());
}

// `Library` is made of an Input, and has `methods()` and `name()`. For the list it is made of an empty one.
template <class Library>
int serve(int arguments, char **argument) {
  if (arguments == 2 && !std::strcmp(argument[1], "--list")) {
    Library library{Input{}};
    std::printf("%s\n", Library::name().c_str());
    for (const Method &method : library.methods()) {
      std::printf("%s\t%s\n", method.results.c_str(), method.name.c_str());
    }
    return EXIT_SUCCESS;
  }
  std::int64_t head[4];
  while (std::fread(head, sizeof *head, 4, stdin) == 4) {
    Input input;
    read(input.positions, 3 * head[1]);
    read(input.triangles, 3 * head[2]);
    read(input.quads, 4 * head[3]);
    Library library{input};
    std::vector<double> results;
    for (const Method &method : library.methods()) {
      const bool wanted = head[0] & 1;
      head[0] >>= 1;
      if (!wanted) {
        continue;
      }
      results.assign(input.vertices() * method.width(), 0.0);
      const std::clock_t start = std::clock();
      method.run(results.data());
      const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      must(std::fwrite(&seconds, sizeof seconds, 1, stdout) == 1);
      must(std::fwrite(results.data(), sizeof(double), results.size(), stdout) == results.size());
    }
    must(std::fflush(stdout) == 0);
  }
  return EXIT_SUCCESS;
}

} // namespace peer
