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
static_assert(!std::is_constructible_v<umbilic::points, const Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> &>);
static_assert(!std::is_constructible_v<umbilic::scalars, const Rows &> && std::is_constructible_v<umbilic::scalars, const Eigen::VectorXd &>);

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

  // Blocks, with their strides.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> wide(4, 7);
  wide.setConstant(-7);
  wide.middleCols(1, 3) = positions;
  auto target = wide.middleCols(4, 3);
  umbilic::vertex_normals(mesh, wide.middleCols<3>(1), target);
  CHECK(wide.middleCols(4, 3) == normals && (wide.col(0).array() == -7).all() && wide.middleCols(1, 3) == positions);
  umbilic::curvature_outputs strided;
  auto column = wide.col(5);
  strided.k1 = column;
  umbilic::curvatures(mesh, positions, strided);
  CHECK(wide.col(5) == k1 && wide.col(4) == normals.col(0) && wide.col(6) == normals.col(2));
  CHECK(umbilic::scalars(column).stride == 7 * sizeof(double) && umbilic::scalars(k1).count == 4);
  umbilic::status result;
  umbilic::vertex_normals(mesh, wide, normals, {}, result);
  CHECK(result.value() == UMB_ERROR_SIZE);
  umbilic::vertex_normals(mesh, positions, wide, {}, result);
  CHECK(result.value() == UMB_ERROR_SIZE);
  umbilic::vertex_normals(mesh, umbilic::points(column), normals, {}, result);
  CHECK(result.value() == UMB_ERROR_SIZE);

  // Faces by the number of columns; those that do not lie in a row are refused.
  Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> quads(2, 4);
  quads << 0, 1, 2, 3, 3, 2, 1, 0;
  CHECK(umbilic::faces(quads).arity == 4 && umbilic::faces(quads).size() == 2 && umbilic::faces(triangles).arity == 3);
  const umbilic::topology refused(quads.leftCols(3), 4, {}, result);
  CHECK(result && !refused);
  const umbilic::topology unlike(umbilic::faces(quads, 2), 4, {}, result);
  CHECK(result && !unlike);
  const Eigen::VectorXi flat = Eigen::VectorXi::LinSpaced(6, 0, 5);
  const umbilic::topology two(flat, 6, {}, result);
  CHECK(!result && two.face_count() == 2);
  const umbilic::topology every_other(Eigen::Map<const Eigen::VectorXi, 0, Eigen::InnerStride<2>>(flat.data(), 3), 6, {}, result);
  CHECK(result && !every_other);
  std::puts("eigen: matrices by rows, vectors in a row");
  return 0;
}
