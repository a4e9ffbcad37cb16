/*
 * Corner normals, what changes as vertices move, shapes and segments. A part of umbilic.hpp, which says what holds for all.
 */
#ifndef UMBILIC_PARTS_HPP
#define UMBILIC_PARTS_HPP

#include <umbilic/curvature.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace umbilic {
inline namespace UMBILIC_VARIANT {

// ---- corners ----

/** Copies an element for each original vertex to the vertices of the cut mesh: see `umb_cut_points`. */
inline void cut_points(const cut_mesh &mesh, const points &original, const vectors &into, status &result) noexcept {
  if (!detail::fits(into, mesh.vertex_count(), "into", result)) return;
  result.set(umb_cut_points(mesh.get(), &original, &into, result.room()));
}
inline void cut_points(const cut_mesh &mesh, const points &original, const vectors &into) {
  detail::throwing([&](status &result) { cut_points(mesh, original, into, result); });
}

/** Corner normals, split at creases: see `umb_corner_normals`. `positions` are those of the original vertices. */
inline void corner_normals(const cut_mesh &mesh, const points &positions, const corner_outputs &into, const normal_options &options,
                           status &result) {
  const std::size_t vertices = mesh.vertex_count();
  if (!detail::fits(into.corner, mesh.corner_count(), "corner", result) || !detail::fits(into.normal, vertices, "normal", result) ||
      !detail::fits(into.sum, vertices, "sum", result) || !detail::fits(into.status, vertices, "status", result)) {
    return;
  }
  detail::sized<umb_corner_outputs> outputs;
  outputs.corner = into.corner;
  outputs.normal = into.normal;
  outputs.sum = into.sum;
  outputs.status = into.status;
  detail::run(options, result, [&](const umb_normal_options *plain, umb_error *error) {
    return umb_corner_normals(mesh.get(), &positions, plain, &outputs, error);
  });
}
inline void corner_normals(const cut_mesh &mesh, const points &positions, const corner_outputs &into,
                           const normal_options &options = normal_options()) {
  detail::throwing([&](status &result) { corner_normals(mesh, positions, into, options, result); });
}

/** Corner normals once, straight from faces, `#C x 3`: see `umb_corner_normals_from_faces`. */
inline void corner_normals(const faces &loops, const points &positions, const creases &where, const vectors &corner,
                           const normal_options &options, status &result) {
  if (!detail::fits(corner, loops.index_count, "corner", result)) return;
  detail::run(options, result, [&](const umb_normal_options *plain, umb_error *error) {
    return umb_corner_normals_from_faces(&loops, &positions, &where, plain, &corner, error);
  });
}
inline void corner_normals(const faces &loops, const points &positions, const creases &where, const vectors &corner,
                           const normal_options &options = normal_options()) {
  detail::throwing([&](status &result) { corner_normals(loops, positions, where, corner, options, result); });
}

/** Corner normals in a new array, `#C x 3`: allocates it, and throws. */
template <class Scalar = double>
std::vector<std::array<Scalar, 3>> corner_normals(const faces &loops, const points &positions, const creases &where = creases(),
                                                  const normal_options &options = normal_options()) {
  std::vector<std::array<Scalar, 3>> normals(loops.index_count);
  corner_normals(loops, positions, where, vectors(normals), options);
  return normals;
}

// ---- what moves ----

/** Lists the vertices whose normals may change, as far as there is room (none: their number alone); answers how many: see `umb_affected_normals`. */
inline std::size_t affected_normals(topology_view mesh, const moved &which, const normal_options &options, span<std::uint32_t> room,
                                    status &result) noexcept {
  std::size_t count = 0;
  result.set(umb_affected_normals(mesh.get(), &which, &options, room.data(), room.size(), &count, result.room()));
  return count;
}
/** Likewise in a new array: allocates room for `#V`, and throws. */
inline std::vector<std::uint32_t> affected_normals(topology_view mesh, const moved &which,
                                                   const normal_options &options = normal_options()) {
  std::vector<std::uint32_t> list(mesh.vertex_count());
  detail::throwing([&](status &result) { list.resize(affected_normals(mesh, which, options, {list.data(), list.size()}, result)); });
  return list;
}

/** Likewise for curvatures: see `umb_affected_curvatures`. */
inline std::size_t affected_curvatures(topology_view mesh, const moved &which, const curvature_options &options,
                                       span<std::uint32_t> room, status &result) noexcept {
  std::size_t count = 0;
  result.set(umb_affected_curvatures(mesh.get(), &which, &options, room.data(), room.size(), &count, result.room()));
  return count;
}
/** Likewise in a new array: allocates room for `#V`, and throws. */
inline std::vector<std::uint32_t> affected_curvatures(topology_view mesh, const moved &which,
                                                      const curvature_options &options = curvature_options()) {
  std::vector<std::uint32_t> list(mesh.vertex_count());
  detail::throwing([&](status &result) { list.resize(affected_curvatures(mesh, which, options, {list.data(), list.size()}, result)); });
  return list;
}

// ---- shapes and segments ----

/** A tolerance for `shape_classes` that goes with the size of a mesh, 1/length: see `umb_shape_tolerance`. */
inline double shape_tolerance(const points &positions, status &result) noexcept {
  double tolerance = 0.0;
  result.set(umb_shape_tolerance(&positions, &tolerance, result.room()));
  return tolerance;
}
inline double shape_tolerance(const points &positions) {
  double tolerance = 0.0;
  detail::throwing([&](status &result) { tolerance = shape_tolerance(positions, result); });
  return tolerance;
}

/** The shape class, a `UMB_SHAPE_` constant, of each of `k1`, by the tolerance or the points of the options: see `umb_shape_classes`. */
inline void shape_classes(const scalars &k1, const scalars &k2, const byte_output &classes, const shape_options &options,
                          status &result) {
  if (!detail::fits(classes, k1.count, "classes", result)) return;
  detail::run(options, result, [&](const umb_shape_options *plain, umb_error *error) {
    return umb_shape_classes(&k1, &k2, plain, &classes, error);
  });
}
inline void shape_classes(const scalars &k1, const scalars &k2, const byte_output &classes, const shape_options &options) {
  detail::throwing([&](status &result) { shape_classes(k1, k2, classes, options, result); });
}
/** Likewise, with the default tolerance by the size of the mesh. */
inline void shape_classes(const points &positions, const scalars &k1, const scalars &k2, const byte_output &classes) {
  shape_options options;
  options.points = &positions;
  shape_classes(k1, k2, classes, options);
}

namespace detail {

template <class Options, class Segment>
segmentation segmented(const faces &loops, const points &positions, const Options &options, status &result, Segment segment) {
  umb_segmentation *handle = nullptr;
  run(options, result, [&](const typename Options::plain *plain, umb_error *error) {
    return segment(&loops, &positions, plain, &handle, error);
  });
  return segmentation(handle);
}

}  // namespace detail

/** Segments that creases bound: see `umb_segment_features`. Empty after a failure. */
inline segmentation segment(const faces &loops, const points &positions, const feature_options &options, status &result) {
  return detail::segmented(loops, positions, options, result, umb_segment_features);
}
/** Basins of curvedness or of a height: see `umb_segment_watershed`. Empty after a failure. */
inline segmentation segment(const faces &loops, const points &positions, const watershed_options &options, status &result) {
  return detail::segmented(loops, positions, options, result, umb_segment_watershed);
}
/** Regions of one shape: see `umb_segment_regions`. Empty after a failure. */
inline segmentation segment(const faces &loops, const points &positions, const region_options &options, status &result) {
  return detail::segmented(loops, positions, options, result, umb_segment_regions);
}
/** Any of the three, by its options. */
template <class Options>
segmentation segment(const faces &loops, const points &positions, const Options &options) {
  segmentation found;
  detail::throwing([&](status &result) { found = segment(loops, positions, options, result); });
  return found;
}

}  // namespace UMBILIC_VARIANT
}  // namespace umbilic

#endif  // UMBILIC_PARTS_HPP
