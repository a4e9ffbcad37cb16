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
namespace openmesh {

/**
 * Error quadrics by curvature: the priority of OpenMesh's `ModQuadricT`, times the curvedness at the edge to some power.
 *
 * Where edges are h long and the surface curved by c, a collapse costs plain quadrics about c^2 h^6 (the square of a distance by an area),
 * so that edges end up in proportion to c^(-1/3): best for distances. The mean square of the angle between normals is least with edges
 * in proportion to c^(-1/2), and that is what quadrics times c give. So 0 is plain quadrics, and 1 is for normals and shading; beyond that,
 * curved places keep more than their share.
 *
 * Binary, after `set_largest_turn`: it allows a collapse if the curvedness times the length of the edge, the angle by which the surface turns
 * along it, is small enough; another module says in which order. So flat parts get coarse, and curved ones stay fine.
 *
 * Curvedness is that of the mesh as it is at `initialize()`, at vertices that stay where they are.
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

  explicit ModCurvatureT(Mesh &mesh) : Base(mesh) { mesh.add_property(curvedness_); }
  ~ModCurvatureT() override { Base::mesh().remove_property(curvedness_); }

  /** The power of the curvedness, at least 0; 1 at first. */
  void set_power(double power) noexcept { power_ = power; }
  double power() const noexcept { return power_; }

  /** How curvature is estimated; adaptive jets at first. What it points to has to live until `initialize()`. */
  void set_options(const curvature_options &options) noexcept { options_ = options; }

  /** Makes the module binary: radians by which the surface may turn along an edge that collapses. */
  void set_largest_turn(double radians) noexcept {
    largest_turn_ = radians;
    Base::set_binary(true);
  }
  /** Undoes it. */
  void unset_largest_turn() noexcept {
    largest_turn_ = 0.0;
    Base::set_binary(false);
  }

  /** Computes quadrics and curvedness. Throws `umbilic::error`. */
  void initialize() override {
    Base::initialize();
    Mesh &mesh = Base::mesh();
    curvature_outputs into;
    into.curvedness = detail::array_of(mesh, curvedness_);
    const host_topology rings = build_topology(mesh);
    const detail::positions<Mesh> positions(mesh);
    umbilic::curvatures(rings, positions, into, rings.restrict_to_existing(options_));
    // What is flat to the size of the mesh: there quadrics alone decide.
    least_ = std::max(shape_tolerance(positions), std::numeric_limits<double>::min());
  }

  float collapse_priority(const CollapseInfo &info) override {
    Mesh &mesh = Base::mesh();
    const double curvedness = std::max<double>(mesh.property(curvedness_, info.v0), mesh.property(curvedness_, info.v1));
    if (Base::is_binary()) {
      const double turn = curvedness * static_cast<double>((info.p1 - info.p0).norm());
      return static_cast<float>(turn <= largest_turn_ ? Base::LEGAL_COLLAPSE : Base::ILLEGAL_COLLAPSE);
    }
    const float error = Base::collapse_priority(info);
    if (error < 0.0F) return error;
    return static_cast<float>(static_cast<double>(error) * std::pow(std::max(curvedness / least_, 1.0), power_));
  }

  /** Of the bound that makes it binary: a factor of 0 to 1. */
  void set_error_tolerance_factor(double factor) override {
    if (!Base::is_binary() || !(factor >= 0.0 && factor <= 1.0)) return;
    largest_turn_ *= factor / this->error_tolerance_factor_;
    this->error_tolerance_factor_ = factor;
  }

 private:
  OpenMesh::VPropHandleT<detail::scalar<Mesh>> curvedness_;
  curvature_options options_;
  double power_ = 1.0, largest_turn_ = 0.0, least_ = 1.0;
};

}  // namespace openmesh
}  // namespace umbilic

#endif  // UMBILIC_OPENMESH_DECIMATER_HPP
