/*
 * Vertex and face normals, and what adaptive jets learn of a mesh. A part of umbilic.hpp, which says what holds for all.
 */
#ifndef UMBILIC_NORMALS_HPP
#define UMBILIC_NORMALS_HPP

#include <umbilic/handles.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace umbilic {
inline namespace UMBILIC_VARIANT {

// ---- normals ----

namespace detail {

inline bool plain(const normal_outputs &into, std::size_t vertices, sized<umb_normal_outputs> &outputs, status &result) noexcept {
  outputs.normal = into.normal;
  outputs.sum = into.sum;
  outputs.status = into.status;
  return fits(into.normal, vertices, "normal", result) && fits(into.sum, vertices, "sum", result) &&
         fits(into.status, vertices, "status", result);
}

inline normal_outputs only_normals(const vectors &normals) noexcept {
  normal_outputs into;
  into.normal = normals;
  return into;
}

}  // namespace detail

/** Learns what adaptive jets use of a mesh: see `umb_learn_model`. Of `options` only how to run counts. */
inline void learn_model(topology_view mesh, const points &positions, adaptive_model &model, const normal_options &options,
                        status &result) {
  detail::run(options, result, [&](const umb_normal_options *plain, umb_error *error) {
    return umb_learn_model(mesh.get(), &positions, plain, &model, error);
  });
}
inline adaptive_model learn_model(topology_view mesh, const points &positions, const normal_options &options = normal_options()) {
  adaptive_model model;
  detail::throwing([&](status &result) { learn_model(mesh, positions, model, options, result); });
  return model;
}

/** Vertex normals and more, `#V` elements each: see `umb_vertex_normals`. */
inline void vertex_normals(topology_view mesh, const points &positions, const normal_outputs &into, const normal_options &options,
                           status &result) {
  detail::sized<umb_normal_outputs> outputs;
  if (!detail::plain(into, mesh.vertex_count(), outputs, result)) return;
  detail::run(options, result, [&](const umb_normal_options *plain, umb_error *error) {
    return umb_vertex_normals(mesh.get(), &positions, plain, &outputs, error);
  });
}
inline void vertex_normals(topology_view mesh, const points &positions, const normal_outputs &into,
                           const normal_options &options = normal_options()) {
  detail::throwing([&](status &result) { vertex_normals(mesh, positions, into, options, result); });
}

/** Unit vertex normals, `#V x 3`. */
inline void vertex_normals(topology_view mesh, const points &positions, const vectors &normals, const normal_options &options,
                           status &result) {
  vertex_normals(mesh, positions, detail::only_normals(normals), options, result);
}
inline void vertex_normals(topology_view mesh, const points &positions, const vectors &normals,
                           const normal_options &options = normal_options()) {
  vertex_normals(mesh, positions, detail::only_normals(normals), options);
}

/** Vertex normals once, straight from faces: see `umb_vertex_normals_from_faces`. */
inline void vertex_normals(const faces &loops, const points &positions, const normal_outputs &into, const normal_options &options,
                           status &result) {
  detail::sized<umb_normal_outputs> outputs;
  if (!detail::plain(into, positions.count, outputs, result)) return;
  detail::run(options, result, [&](const umb_normal_options *plain, umb_error *error) {
    return umb_vertex_normals_from_faces(&loops, &positions, plain, &outputs, error);
  });
}
inline void vertex_normals(const faces &loops, const points &positions, const normal_outputs &into,
                           const normal_options &options = normal_options()) {
  detail::throwing([&](status &result) { vertex_normals(loops, positions, into, options, result); });
}
inline void vertex_normals(const faces &loops, const points &positions, const vectors &normals, const normal_options &options,
                           status &result) {
  vertex_normals(loops, positions, detail::only_normals(normals), options, result);
}
inline void vertex_normals(const faces &loops, const points &positions, const vectors &normals,
                           const normal_options &options = normal_options()) {
  vertex_normals(loops, positions, detail::only_normals(normals), options);
}

/** Unit vertex normals in a new array, `#V x 3`: allocates it, and throws. */
template <class Scalar = double>
std::vector<std::array<Scalar, 3>> vertex_normals(topology_view mesh, const points &positions,
                                                  const normal_options &options = normal_options()) {
  std::vector<std::array<Scalar, 3>> normals(mesh.vertex_count());
  vertex_normals(mesh, positions, vectors(normals), options);
  return normals;
}
template <class Scalar = double>
std::vector<std::array<Scalar, 3>> vertex_normals(const faces &loops, const points &positions,
                                                  const normal_options &options = normal_options()) {
  // A flat array of a wrong length has no count; the call says so.
  std::vector<std::array<Scalar, 3>> normals(positions.count == detail::NONE ? 0 : positions.count);
  vertex_normals(loops, positions, vectors(umb_output(vectors(normals))), options);
  return normals;
}

/** Face normals and area vectors (length^2), `#F` elements each: see `umb_face_normals`. */
inline void face_normals(const faces &loops, const points &positions, const face_outputs &into, const face_options &options,
                         status &result) {
  const std::size_t count = loops.size();
  if (!detail::fits(into.normal, count, "normal", result) || !detail::fits(into.area_vector, count, "area_vector", result) ||
      !detail::fits(into.status, count, "status", result)) {
    return;
  }
  detail::sized<umb_face_outputs> outputs;
  outputs.normal = into.normal;
  outputs.area_vector = into.area_vector;
  outputs.status = into.status;
  detail::run(options, result, [&](const umb_face_options *plain, umb_error *error) {
    return umb_face_normals(&loops, &positions, plain, &outputs, error);
  });
}
inline void face_normals(const faces &loops, const points &positions, const face_outputs &into,
                         const face_options &options = face_options()) {
  detail::throwing([&](status &result) { face_normals(loops, positions, into, options, result); });
}

/** Unit face normals in a new array, `#F x 3`: allocates it, and throws. */
template <class Scalar = double>
std::vector<std::array<Scalar, 3>> face_normals(const faces &loops, const points &positions,
                                                const face_options &options = face_options()) {
  // So that a count of faces that is wrong is refused before it is believed.
  std::vector<std::array<Scalar, 3>> normals(loops.size() == detail::NONE ? 0 : loops.size());
  face_outputs into;
  into.normal = vectors(normals);
  face_normals(loops, positions, into, options);
  return normals;
}

}  // namespace UMBILIC_VARIANT
}  // namespace umbilic

#endif  // UMBILIC_NORMALS_HPP
