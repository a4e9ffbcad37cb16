/*
 * For adapters to hosts: curvatures by name, gaps that deleted vertices leave. A part of umbilic.hpp, which says what holds for all.
 */
#ifndef UMBILIC_ADAPTERS_HPP
#define UMBILIC_ADAPTERS_HPP

#include <umbilic/parts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace umbilic {
inline namespace UMBILIC_VARIANT {

// ---- for adapters to hosts: curvatures by name ----

/** Curvatures that an adapter writes to properties of a host's mesh; any of them together, by `|`. */
enum class quantities : std::uint32_t {};
constexpr quantities operator|(quantities a, quantities b) noexcept {
  return static_cast<quantities>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr quantities operator&(quantities a, quantities b) noexcept {
  return static_cast<quantities>(static_cast<std::uint32_t>(a) & static_cast<std::uint32_t>(b));
}

/** One of them each, under the name of its property. */
namespace quantity {
inline constexpr quantities k1{1U << 0};                   // "v:k1", 1/length
inline constexpr quantities k2{1U << 1};                   // "v:k2", 1/length
inline constexpr quantities direction1{1U << 2};           // "v:dir1", unit vectors
inline constexpr quantities direction2{1U << 3};           // "v:dir2", unit vectors
inline constexpr quantities mean{1U << 4};                 // "v:mean", 1/length
inline constexpr quantities gaussian{1U << 5};             // "v:gauss", 1/length^2
inline constexpr quantities mean_normal{1U << 6};          // "v:mean_normal", 1/length
inline constexpr quantities area{1U << 7};                 // "v:area", length^2
inline constexpr quantities integrated_mean{1U << 8};      // "v:integrated_mean", length
inline constexpr quantities integrated_gaussian{1U << 9};  // "v:integrated_gauss"
inline constexpr quantities shape_index{1U << 10};         // "v:shape_index"
inline constexpr quantities curvedness{1U << 11};          // "v:curvedness", 1/length
inline constexpr quantities residual{1U << 12};            // "v:residual"
inline constexpr quantities condition{1U << 13};           // "v:condition"
inline constexpr quantities degrees_of_freedom{1U << 14};  // "v:degrees_of_freedom"
inline constexpr quantities normal{1U << 15};              // "v:fit_normal", unit vectors
inline constexpr quantities status{1U << 16};              // "v:curvature_status", UMB_VERTEX_ bits
/** Those of the first six that a method has. */
constexpr quantities of_method(umb_curvature_method method) noexcept {
  if (method == UMB_CURVATURE_ANGLE_DEFECT) return gaussian;
  if (method == UMB_CURVATURE_WATANABE || method == UMB_CURVATURE_MEYER) return k1 | k2 | mean | gaussian;
  return k1 | k2 | direction1 | direction2 | mean | gaussian;
}
/** Stands for `of_method` of the method that is asked for. */
inline constexpr quantities default_ones{};
}  // namespace quantity

namespace detail {

constexpr bool has(quantities some, quantities one) noexcept { return (some & one) != quantities{}; }

template <class Output>
struct named {
  quantities bit;
  const char *name;
  Output curvature_outputs::*output;
};

inline constexpr named<numbers> NAMED_NUMBERS[] = {{quantity::k1, "v:k1", &curvature_outputs::k1},
                                            {quantity::k2, "v:k2", &curvature_outputs::k2},
                                            {quantity::mean, "v:mean", &curvature_outputs::mean},
                                            {quantity::gaussian, "v:gauss", &curvature_outputs::gaussian},
                                            {quantity::area, "v:area", &curvature_outputs::area},
                                            {quantity::integrated_mean, "v:integrated_mean", &curvature_outputs::integrated_mean},
                                            {quantity::integrated_gaussian, "v:integrated_gauss", &curvature_outputs::integrated_gaussian},
                                            {quantity::shape_index, "v:shape_index", &curvature_outputs::shape_index},
                                            {quantity::curvedness, "v:curvedness", &curvature_outputs::curvedness},
                                            {quantity::residual, "v:residual", &curvature_outputs::residual},
                                            {quantity::condition, "v:condition", &curvature_outputs::condition},
                                            {quantity::degrees_of_freedom, "v:degrees_of_freedom", &curvature_outputs::degrees_of_freedom}};
inline constexpr named<vectors> NAMED_VECTORS[] = {{quantity::direction1, "v:dir1", &curvature_outputs::direction1},
                                            {quantity::direction2, "v:dir2", &curvature_outputs::direction2},
                                            {quantity::mean_normal, "v:mean_normal", &curvature_outputs::mean_normal},
                                            {quantity::normal, "v:fit_normal", &curvature_outputs::normal}};
inline constexpr const char *STATUS_NAME = "v:curvature_status";

/**
 * Whether the positions of vertices that do not exist make no difference: they are finite, and in the box of those that do, by which default
 * tolerances go.
 */
template <class Vector, class Exists>
bool gaps_make_no_difference(const Vector *data, std::size_t count, const Exists &exists) {
  using Scalar = std::decay_t<decltype(data[0][0])>;
  constexpr Scalar FAR = std::numeric_limits<Scalar>::infinity();
  const auto at = [&](std::size_t v) { return std::array<Scalar, 3>{data[v][0], data[v][1], data[v][2]}; };
  std::array<Scalar, 3> low = {FAR, FAR, FAR}, high = {-FAR, -FAR, -FAR};
  for (std::size_t v = 0; v < count; v++) {
    if (!exists(v)) continue;
    const std::array<Scalar, 3> position = at(v);
    for (std::size_t k = 0; k < 3; k++) {
      low[k] = std::min(low[k], position[k]);
      high[k] = std::max(high[k], position[k]);
    }
  }
  for (std::size_t v = 0; v < count; v++) {
    if (exists(v)) continue;
    const std::array<Scalar, 3> position = at(v);
    for (std::size_t k = 0; k < 3; k++) {
      if (!(low[k] <= position[k] && position[k] <= high[k])) return false;
    }
  }
  return true;
}

/** Puts vertices that do not exist where the first one lies that does and is finite: none of them is to blame for one that is not. */
template <class Scalar, class Exists>
void fill_gaps(std::vector<std::array<Scalar, 3>> &positions, const Exists &exists) {
  std::array<Scalar, 3> first = {0, 0, 0};
  for (std::size_t v = 0; v < positions.size(); v++) {
    const auto is_finite = [](Scalar coordinate) { return std::isfinite(coordinate); };
    if (!exists(v) || !std::all_of(positions[v].begin(), positions[v].end(), is_finite)) continue;
    first = positions[v];
    break;
  }
  for (std::size_t v = 0; v < positions.size(); v++) {
    if (!exists(v)) positions[v] = first;
  }
}

}  // namespace detail

/**
 * What adapters keep of a mesh beside its topology: which of its vertices and faces are there, where a host leaves gaps for those that were
 * deleted. Indices of vertices are the host's; faces are numbered without gaps.
 */
class host_topology : public topology {
 public:
  explicit host_topology() noexcept = default;
  host_topology(topology &&built, bool has_gaps, std::vector<std::uint32_t> &&existing) noexcept
      : topology(std::move(built)), existing_(std::move(existing)), has_gaps_(has_gaps) {}

  /** Whether some vertices are deleted. */
  bool has_gaps() const noexcept { return has_gaps_; }

  /** Options for the vertices that are there, or for those that the caller lists. */
  template <class Options>
  Options restrict_to_existing(Options options) const noexcept {
    if (has_gaps_ && options.run.vertices == nullptr) options.only(existing_);
    return options;
  }

 private:
  std::vector<std::uint32_t> existing_;  // none unless there are gaps
  bool has_gaps_ = false;
};

}  // namespace UMBILIC_VARIANT
}  // namespace umbilic

#endif  // UMBILIC_ADAPTERS_HPP
