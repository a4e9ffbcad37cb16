/*
 * Curvatures of meshes and polylines, and sections. A part of umbilic.hpp, which says what holds for all.
 */
#ifndef UMBILIC_CURVATURE_HPP
#define UMBILIC_CURVATURE_HPP

#include <umbilic/normals.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace umbilic {
inline namespace UMBILIC_VARIANT {

// ---- curvatures ----

/** Curvatures, `#V` elements each: see `umb_curvatures`. */
inline void curvatures(topology_view mesh, const points &positions, const curvature_outputs &into, const curvature_options &options,
                       status &result) {
  const std::size_t count = mesh.vertex_count();
  detail::sized<umb_curvature_outputs> outputs;
  const auto take = [&](umb_output &output, const auto &wanted, const char *name) {
    output = wanted;
    return detail::fits(wanted, count, name, result);
  };
  if (!take(outputs.k1, into.k1, "k1") || !take(outputs.k2, into.k2, "k2") ||
      !take(outputs.direction1, into.direction1, "direction1") || !take(outputs.direction2, into.direction2, "direction2") ||
      !take(outputs.mean, into.mean, "mean") || !take(outputs.gaussian, into.gaussian, "gaussian") ||
      !take(outputs.mean_normal, into.mean_normal, "mean_normal") || !take(outputs.area, into.area, "area") ||
      !take(outputs.integrated_mean, into.integrated_mean, "integrated_mean") ||
      !take(outputs.integrated_gaussian, into.integrated_gaussian, "integrated_gaussian") ||
      !take(outputs.shape_index, into.shape_index, "shape_index") || !take(outputs.curvedness, into.curvedness, "curvedness") ||
      !take(outputs.residual, into.residual, "residual") || !take(outputs.condition, into.condition, "condition") ||
      !take(outputs.degrees_of_freedom, into.degrees_of_freedom, "degrees_of_freedom") ||
      !take(outputs.normal, into.normal, "normal") || !detail::fits(into.status, count, "status", result)) {
    return;
  }
  outputs.status = into.status;
  detail::run(options, result, [&](const umb_curvature_options *plain, umb_error *error) {
    return umb_curvatures(mesh.get(), &positions, plain, &outputs, error);
  });
}
inline void curvatures(topology_view mesh, const points &positions, const curvature_outputs &into,
                       const curvature_options &options = curvature_options()) {
  detail::throwing([&](status &result) { curvatures(mesh, positions, into, options, result); });
}

/** Principal curvatures (1/length) and unit directions, `#V` each. */
template <class Scalar = double>
struct principal_curvatures {
  std::vector<Scalar> k1, k2;
  std::vector<std::array<Scalar, 3>> direction1, direction2;
};

/** Principal curvatures in new arrays, `#V` each: allocates them, and throws; `UMB_ERROR_NOT_APPLICABLE` of methods without directions. */
template <class Scalar = double>
principal_curvatures<Scalar> curvatures(topology_view mesh, const points &positions,
                                        const curvature_options &options = curvature_options()) {
  const std::size_t count = mesh.vertex_count();
  principal_curvatures<Scalar> found;
  found.k1.resize(count), found.k2.resize(count), found.direction1.resize(count), found.direction2.resize(count);
  curvature_outputs into;
  into.k1 = numbers(found.k1), into.k2 = numbers(found.k2);
  into.direction1 = vectors(found.direction1), into.direction2 = vectors(found.direction2);
  curvatures(mesh, positions, into, options);
  return found;
}

namespace detail {

inline bool plain(const section_outputs &into, std::size_t sections, std::size_t vertices, sized<umb_section_outputs> &outputs,
                  status &result) noexcept {
  outputs.curvature = into.curvature;
  outputs.status = into.status;
  outputs.normal = into.normal;
  return fits(into.curvature, sections, "curvature", result) && fits(into.status, sections, "status", result) &&
         fits(into.normal, vertices, "normal", result);
}

}  // namespace detail

/** The curvature along every edge, 1/length, an element for each of `ring_neighbours()`: see `umb_edge_sections`. */
inline void edge_sections(topology_view mesh, const points &positions, const section_outputs &into, const section_options &options,
                          status &result) {
  detail::sized<umb_section_outputs> outputs;
  if (!detail::plain(into, mesh.ring_neighbours().size(), mesh.vertex_count(), outputs, result)) return;
  detail::run(options, result, [&](const umb_section_options *plain, umb_error *error) {
    return umb_edge_sections(mesh.get(), &positions, plain, &outputs, error);
  });
}
inline void edge_sections(topology_view mesh, const points &positions, const section_outputs &into,
                          const section_options &options = section_options()) {
  detail::throwing([&](status &result) { edge_sections(mesh, positions, into, options, result); });
}

/** Curvatures in given directions, 1/length, `#V` or, with a shared set, `#V x #D`: see `umb_direction_sections`. */
inline void direction_sections(topology_view mesh, const points &positions, const section_outputs &into,
                               const section_options &options, status &result) {
  const std::size_t vertices = mesh.vertex_count(), each = options.shared ? options.directions.count : 1;
  const std::size_t sections = each != 0 && vertices > detail::NONE / each ? detail::NONE : vertices * each;
  detail::sized<umb_section_outputs> outputs;
  if (!detail::plain(into, sections, vertices, outputs, result)) return;
  detail::run(options, result, [&](const umb_section_options *plain, umb_error *error) {
    return umb_direction_sections(mesh.get(), &positions, plain, &outputs, error);
  });
}
inline void direction_sections(topology_view mesh, const points &positions, const section_outputs &into,
                               const section_options &options) {
  detail::throwing([&](status &result) { direction_sections(mesh, positions, into, options, result); });
}

/** Curvatures of a polyline, 1/length, `#V` each: see `umb_polyline_curvatures`. */
inline void polyline_curvatures(const polyline &curve, const polyline_outputs &into, const polyline_options &options, status &result) {
  if (!detail::fits(into.circle, curve.count, "circle", result) || !detail::fits(into.parabola, curve.count, "parabola", result) ||
      !detail::fits(into.length_parabola, curve.count, "length_parabola", result) ||
      !detail::fits(into.symmetric_parabola, curve.count, "symmetric_parabola", result) ||
      !detail::fits(into.status, curve.count, "status", result)) {
    return;
  }
  detail::sized<umb_polyline_outputs> outputs;
  outputs.circle = into.circle;
  outputs.parabola = into.parabola;
  outputs.length_parabola = into.length_parabola;
  outputs.symmetric_parabola = into.symmetric_parabola;
  outputs.status = into.status;
  detail::run(options, result, [&](const umb_polyline_options *plain, umb_error *error) {
    return umb_polyline_curvatures(&curve, plain, &outputs, error);
  });
}
inline void polyline_curvatures(const polyline &curve, const polyline_outputs &into,
                                const polyline_options &options = polyline_options()) {
  detail::throwing([&](status &result) { polyline_curvatures(curve, into, options, result); });
}

}  // namespace UMBILIC_VARIANT
}  // namespace umbilic

#endif  // UMBILIC_CURVATURE_HPP
