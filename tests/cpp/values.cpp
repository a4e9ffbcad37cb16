// umbilic.hpp without exceptions and run-time types: errors are values.
#include "umbilic.hpp"

#include "check.hpp"

static_assert(std::is_same_v<umbilic::points, umbilic::without_exceptions::points>, "other names than with exceptions");

int main() {
  const std::vector<std::array<double, 3>> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  std::vector<std::uint32_t> triangle = {0, 1, 2};
  umbilic::status result;
  const umbilic::topology mesh(triangle, positions.size(), {}, result);
  CHECK(!result && mesh);
  std::vector<std::array<float, 3>> normals(3);
  int calls = 0;
  auto watch = [&](double) { calls++; };
  umbilic::normal_options options;
  options.progress = watch;
  umbilic::vertex_normals(mesh, positions, normals, options, result);
  CHECK(!result && normals[0][2] == 1.0f && calls > 0);
  umbilic::vertex_normals(mesh, positions, normals);
  triangle[1] = 3;
  const umbilic::topology refused(triangle, positions.size(), {}, result);
  CHECK(result.value() == UMB_ERROR_INDEX_OUT_OF_RANGE && result.element() == 1 && !refused);
  std::puts("values: no exception was needed");
  return 0;
}
