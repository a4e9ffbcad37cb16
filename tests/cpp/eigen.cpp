// Eigen's vectors and matrices as they are, and not those that are stored column by column.
#include "umbilic.hpp"

#include <Eigen/Core>

#include "check.hpp"

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using RowsFloat = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
static_assert(std::is_constructible_v<umbilic::points, const Rows &> && std::is_constructible_v<umbilic::vectors, Rows &>);
static_assert(!std::is_constructible_v<umbilic::vectors, const Rows &>);
static_assert(!std::is_constructible_v<umbilic::points, const Eigen::MatrixXd &>, "x of all vertices stands before y");
static_assert(!std::is_constructible_v<umbilic::faces, const Eigen::MatrixXi &>);

}  // namespace

int main() {
  Rows positions(4, 3);
  positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  Triangles triangles(4, 3);
  triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  const umbilic::topology mesh(triangles, static_cast<std::size_t>(positions.rows()));
  Rows normals(4, 3);
  umbilic::vertex_normals(mesh, positions, normals);
  CHECK((normals.row(0).transpose() + Eigen::Vector3d::Constant(std::sqrt(1.0 / 3))).norm() < 1e-15);
  std::vector<Eigen::Vector3f> each(4);
  const RowsFloat rounded = positions.cast<float>();
  umbilic::vertex_normals(mesh, rounded, each);
  CHECK((each[3].cast<double>() - normals.row(3).transpose()).norm() < 1e-6);
  Eigen::VectorXd k1(4), k2(4);
  umbilic::curvature_outputs into;
  into.k1 = k1;
  into.k2 = k2;
  umbilic::curvatures(mesh, positions, into);
  CHECK(k1[0] > 0 && k1[0] >= k2[0]);
  std::puts("eigen: matrices by rows, vectors in a row");
  return 0;
}
