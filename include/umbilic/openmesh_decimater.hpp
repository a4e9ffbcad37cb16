/*
 * A module for OpenMesh's decimaters that is steered by curvature. Link with umbilic, OpenMeshCore and OpenMeshTools.
 *
 *   using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;
 *   OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
 *   umbilic::openmesh::ModCurvatureT<Mesh>::Handle curvature;
 *   decimater.add(curvature);
 *   decimater.initialize();
 *   decimater.decimate_to(1000);
 *   mesh.garbage_collection();
 */
#ifndef UMBILIC_OPENMESH_DECIMATER_HPP
#define UMBILIC_OPENMESH_DECIMATER_HPP

#include <umbilic/openmesh.hpp>

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <cmath>

namespace umbilic {
inline namespace UMBILIC_VARIANT {
namespace openmesh {

/**
 * Error quadrics by curvature and normals, for what is to be shaded: the priority of a collapse is
 *
 *   (q + w sum A^2 |n - N|^2) c^p
 *
 * where q is that of OpenMesh's `ModQuadricT` (squares of distances by areas), and the sum goes over the faces that the collapse changes: A is the
 * area of such a face, n its normal, N the mean of the normals of the surface at its corners; c is the curvedness at the edge. Normals and
 * curvedness are those of the mesh as it is at `initialize()`, by a fit; vertices that are left stay where they are.
 *
 * p = 1/2 and w = 0.03 at first; with p = 0 and w = 0 it is `ModQuadricT`. Quadrics alone put edges in proportion to c^(-1/3), best for
 * distances; a power moves faces to where the surface turns. With 5 % of the faces left, angles between the normals of faces fell by 1 to 9 % on
 * four smooth meshes, those of shading by 6 to 18 %, and distances changed by -3 to 7 %; on two machine parts angles fell by 28 to 73 %, while
 * distances grew to 2.6 and 3.2 times, to 0.6 and 1.6 thousandths of the diagonal (examples_c/openmesh_decimate.cpp).
 *
 * Binary, after `set_largest_turn`: it allows a collapse if the curvedness times the length of the edge, the angle by which the surface turns
 * along it, is small enough; another module says in which order. So flat parts get coarse, and curved ones stay fine.
 */
template <class MeshT>
class ModCurvatureT : public OpenMesh::Decimater::ModQuadricT<MeshT> {
 public:
  using Self = ModCurvatureT<MeshT>;
  using Handle = OpenMesh::Decimater::ModHandleT<Self>;
  using Base = OpenMesh::Decimater::ModQuadricT<MeshT>;
  using Mesh = MeshT;
  using CollapseInfo = typename Base::CollapseInfo;
  DECIMATER_MODNAME(Curvature)

  explicit ModCurvatureT(Mesh &mesh) : Base(mesh) {
    mesh.add_property(curvedness_);
    mesh.add_property(normal_);
  }
  ~ModCurvatureT() override {
    Base::mesh().remove_property(curvedness_);
    Base::mesh().remove_property(normal_);
  }

  /** p, the power of the curvedness, at least 0. */
  void set_power(double power) noexcept { power_ = power; }
  double power() const noexcept { return power_; }

  /** w, the weight of normals, at least 0; without unit. */
  void set_normal_weight(double weight) noexcept { normal_weight_ = weight; }
  double normal_weight() const noexcept { return normal_weight_; }

  /** How normals and curvature are estimated; adaptive jets at first. What it points to has to live until `initialize()`. */
  void set_options(const curvature_options &options) noexcept { options_ = options; }

  /** Makes the module binary: radians by which the surface may turn along an edge that collapses. */
  void set_largest_turn(double radians) noexcept {
    largest_turn_ = radians;
    Base::set_binary(true);
  }
  /** Undoes it. */
  void unset_largest_turn() noexcept {
    largest_turn_ = UNBOUNDED;
    Base::set_binary(false);
  }

  /** Computes quadrics, normals and curvedness. Throws `umbilic::error`. */
  void initialize() override {
    Base::initialize();
    Mesh &mesh = Base::mesh();
    curvature_outputs into;
    into.curvedness = detail::array_of(mesh, curvedness_);
    into.normal = detail::array_of(mesh, normal_);
    const host_topology rings = build_topology(mesh);
    const detail::positions<Mesh> positions(mesh, rings.has_gaps());
    umbilic::curvatures(rings, positions, into, rings.restrict_to_existing(options_));
    // What is flat to the size of the mesh: there quadrics alone decide.
    least_ = std::max(shape_tolerance(positions), std::numeric_limits<double>::min());
  }

  float collapse_priority(const CollapseInfo &info) override {
    Mesh &mesh = Base::mesh();
    const double curvedness = std::max<double>(mesh.property(curvedness_, info.v0), mesh.property(curvedness_, info.v1));
    // Not by `is_binary()`: ModQuadricT's `set_max_err` sets that as well.
    if (largest_turn_ != UNBOUNDED) {
      const double turn = curvedness * static_cast<double>((info.p1 - info.p0).norm());
      return static_cast<float>(turn <= largest_turn_ * this->error_tolerance_factor_ ? Base::LEGAL_COLLAPSE : Base::ILLEGAL_COLLAPSE);
    }
    const float error = Base::collapse_priority(info);
    if (error < 0.0F) return error;
    const double turned = normal_weight_ > 0.0 ? normal_weight_ * normal_error(info) : 0.0;
    return static_cast<float>((static_cast<double>(error) + turned) * std::pow(std::max(curvedness / least_, 1.0), power_));
  }

  /** Of the bound that makes it binary: a factor of 0 to 1. Without `set_largest_turn` that of ModQuadricT. */
  void set_error_tolerance_factor(double factor) override {
    if (largest_turn_ == UNBOUNDED) {
      Base::set_error_tolerance_factor(factor);
    } else if (factor >= 0.0 && factor <= 1.0) {
      this->error_tolerance_factor_ = factor;
    }
  }

 private:
  using Vector = OpenMesh::Vec3d;
  static constexpr double UNBOUNDED = std::numeric_limits<double>::infinity();

  template <class From>
  static Vector wide(const From &from) {
    return Vector(static_cast<double>(from[0]), static_cast<double>(from[1]), static_cast<double>(from[2]));
  }

  // The sum over the faces that are left of those around v0, once it lies where v1 does; length^4.
  double normal_error(const CollapseInfo &info) {
    const Mesh &mesh = Base::mesh();
    double sum = 0.0;
    for (const auto halfedge : mesh.voh_range(info.v0)) {
      if (mesh.is_boundary(halfedge)) continue;
      const auto a = mesh.to_vertex_handle(halfedge), b = mesh.to_vertex_handle(mesh.next_halfedge_handle(halfedge));
      if (a == info.v1 || b == info.v1) continue;
      const Vector corner = wide(info.p1);
      const Vector twice_area = (wide(mesh.point(a)) - corner).cross(wide(mesh.point(b)) - corner);
      const Vector normals = wide(mesh.property(normal_, info.v1)) + wide(mesh.property(normal_, a)) + wide(mesh.property(normal_, b));
      const double twice = twice_area.norm(), length = normals.norm();
      if (twice > 0.0 && length > 0.0) sum += 0.25 * twice * twice * (twice_area / twice - normals / length).sqrnorm();
    }
    return sum;
  }

  OpenMesh::VPropHandleT<detail::scalar<Mesh>> curvedness_;
  OpenMesh::VPropHandleT<detail::vector<Mesh>> normal_;
  curvature_options options_;
  double power_ = 0.5, normal_weight_ = 0.03, largest_turn_ = UNBOUNDED, least_ = 1.0;
};

}  // namespace openmesh
}  // namespace UMBILIC_VARIANT
}  // namespace umbilic

#endif  // UMBILIC_OPENMESH_DECIMATER_HPP
