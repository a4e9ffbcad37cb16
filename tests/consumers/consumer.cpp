// A program of a user's: prints normals and principal curvatures of a torus, to the last bit, as consumer.c does.
#include <umbilic.hpp>

#include <cmath>
#include <cstdio>
#include <string>

int main() {
  constexpr std::uint32_t around = 24, across = 12, vertices = around * across;
  std::vector<std::array<double, 3>> positions, normals(vertices);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t v = 0; v < vertices; v++) {
    const std::uint32_t i = v / across, j = v % across;
    const std::uint32_t i1 = (i + 1) % around * across, j1 = (j + 1) % across;
    const double u = 6.283185307179586 * i / around, w = 6.283185307179586 * j / across;
    positions.push_back({std::cos(u) * (1.0 + 0.4 * std::cos(w)), std::sin(u) * (1.0 + 0.4 * std::cos(w)), 0.4 * std::sin(w)});
    triangles.push_back({v, i1 + j, i1 + j1});
    triangles.push_back({v, i1 + j1, i * across + j1});
  }

  if (umb_abi_version() != UMB_ABI_VERSION || umb_version() != std::string(VERSION)) return 1;
  const umbilic::topology mesh(triangles, positions.size());
  umbilic::vertex_normals(mesh, positions, normals);
  const auto curvatures = umbilic::curvatures<double>(mesh, positions);
  for (std::uint32_t v = 0; v < vertices; v++)
    std::printf("%a %a %a %a %a\n", normals[v][0], normals[v][1], normals[v][2], curvatures.k1[v], curvatures.k2[v]);
}
