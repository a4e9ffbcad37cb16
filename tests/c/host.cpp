// A host in C++: handles that free themselves, vectors, threads, and exceptions that pass by the library's calls. From C++11 on.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "umbilic.h"

namespace {

using Vector = std::array<double, 3>;

struct Destroy {
  void operator()(umb_topology *topology) const { umb_topology_destroy(topology); }
};
using Topology = std::unique_ptr<umb_topology, Destroy>;

// What a host does with a status.
void check(umb_status status, const umb_error &error) {
  if (status != UMB_OK) throw std::runtime_error(std::string(umb_status_string(status)) + ": " + error.message);
}

void require(bool condition, const char *what) {
  if (condition) return;
  std::fprintf(stderr, "host: %s\n", what);
  std::exit(EXIT_FAILURE);
}

// A cube of six quads, about the origin.
const std::vector<Vector> corners = {{{-1, -1, -1}}, {{1, -1, -1}}, {{1, 1, -1}}, {{-1, 1, -1}},
                                     {{-1, -1, 1}},  {{1, -1, 1}},  {{1, 1, 1}},  {{-1, 1, 1}}};
const std::vector<std::uint32_t> quads = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};

Topology build(const std::vector<std::uint32_t> &indices) {
  umb_faces faces = umb_faces();
  faces.indices = indices.data();
  faces.index_count = indices.size();
  faces.arity = 4;
  umb_error error = UMB_ERROR_INIT;
  umb_topology *topology = nullptr;
  check(umb_topology_create(&faces, corners.size(), nullptr, &topology, &error), error);
  return Topology(topology);
}

std::vector<Vector> normals(const umb_topology *topology, umb_weight weight, std::uint32_t threads) {
  std::vector<Vector> found(corners.size());
  umb_points points = umb_points();
  points.data = corners.data();
  points.count = corners.size();
  points.scalar = UMB_SCALAR_F64;
  umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
  options.weight = weight;
  options.run.threads = threads;
  umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT;
  outputs.normal.data = found.data();
  outputs.normal.scalar = UMB_SCALAR_F64;
  umb_error error = UMB_ERROR_INIT;
  check(umb_vertex_normals(topology, &points, &options, &outputs, &error), error);
  return found;
}

// A status becomes an exception of the host's, on any thread.
void failing() {
  std::vector<std::uint32_t> wrong = quads;
  wrong[7] = 8;
  try {
    build(wrong);
    require(false, "a face that names a vertex that is not there was taken");
  } catch (const std::runtime_error &failure) {
    require(std::string(failure.what()).find("faces.indices[7]") != std::string::npos, failure.what());
  }
}

}  // namespace

int main() {
  const Topology topology = build(quads);
  std::vector<std::thread> threads;
  for (std::uint32_t number = 0; number < 8; number++) {
    threads.emplace_back([&topology, number] {
      for (std::uint32_t round = 0; round < 20; round++) {
        for (const Vector &normal : normals(topology.get(), (number + round) % 10, 1 + round % 3)) {
          for (double component : normal) require(std::abs(std::abs(component) - std::sqrt(1.0 / 3)) < 1e-15, "not along a diagonal");
        }
        failing();
      }
    });
  }
  for (std::thread &thread : threads) thread.join();
  std::puts("host: threads and exceptions get on with the library");
  return 0;
}
