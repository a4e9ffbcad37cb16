/*
 * Handles that move: topologies, cut meshes, segmentations. A part of umbilic.hpp, which says what holds for all.
 */
#ifndef UMBILIC_HANDLES_HPP
#define UMBILIC_HANDLES_HPP

#include <umbilic/options.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace umbilic {
inline namespace UMBILIC_VARIANT {

// ---- handles ----

/** A topology of someone else's: what functions take. Null as constructed by default, which they refuse. */
class topology_view {
 public:
  topology_view() noexcept = default;
  topology_view(const umb_topology *handle) noexcept : handle_(handle) {}

  /** The handle of C. */
  const umb_topology *get() const noexcept { return handle_; }
  explicit operator bool() const noexcept { return handle_ != nullptr; }

  /** `#V`; 0 for null. */
  std::size_t vertex_count() const noexcept { return umb_topology_vertex_count(handle_); }
  /** `#F`, ignored ones included; 0 for null. */
  std::size_t face_count() const noexcept { return umb_topology_face_count(handle_); }
  /** `UMB_VERTEX_` bits that follow from the faces alone, `#V`. */
  span<const std::uint8_t> flags() const noexcept { return {umb_topology_flags(handle_), vertex_count()}; }
  /** Where each vertex's ring starts in `ring_neighbours`, and the end of the last: `#V + 1`. */
  span<const std::uint32_t> ring_offsets() const noexcept {
    return {umb_topology_ring_offsets(handle_), handle_ ? vertex_count() + 1 : 0};
  }
  /** The neighbours of all vertices, fan after fan, counter-clockwise. */
  span<const std::uint32_t> ring_neighbours() const noexcept {
    return {umb_topology_ring_neighbours(handle_), handle_ ? umb_topology_ring_offsets(handle_)[vertex_count()] : 0};
  }
  /** The ring of a vertex, which has to be below `vertex_count()`. */
  span<const std::uint32_t> ring(std::size_t vertex) const noexcept {
    const std::uint32_t *offsets = umb_topology_ring_offsets(handle_);
    return {umb_topology_ring_neighbours(handle_) + offsets[vertex], offsets[vertex + 1] - offsets[vertex]};
  }

  /** What the mesh is made of, and what is wrong with it. */
  umb_topology_stats stats(status &result) const {
    detail::sized<umb_topology_stats> found;
    result.set(umb_topology_get_stats(handle_, &found, result.room()));
    return found;
  }
  umb_topology_stats stats() const {
    umb_topology_stats found;
    detail::throwing([&](status &result) { found = stats(result); });
    return found;
  }

  /** The number of edges at a vertex. */
  std::size_t valence(std::size_t vertex, status &result) const {
    std::size_t found = 0;
    result.set(umb_topology_valence(handle_, vertex, &found, result.room()));
    return found;
  }
  std::size_t valence(std::size_t vertex) const {
    std::size_t found = 0;
    detail::throwing([&](status &result) { found = valence(vertex, result); });
    return found;
  }

  /** The number of fans of a vertex. */
  std::size_t fan_count(std::size_t vertex, status &result) const {
    std::size_t found = 0;
    result.set(umb_topology_fan_count(handle_, vertex, &found, result.room()));
    return found;
  }
  std::size_t fan_count(std::size_t vertex) const {
    std::size_t found = 0;
    detail::throwing([&](status &result) { found = fan_count(vertex, result); });
    return found;
  }

  /** A fan of a vertex; its neighbours are the handle's memory. */
  umb_fan fan(std::size_t vertex, std::size_t index, status &result) const {
    umb_fan found = umb_fan();
    result.set(umb_topology_fan(handle_, vertex, index, &found, result.room()));
    return found;
  }
  umb_fan fan(std::size_t vertex, std::size_t index) const {
    umb_fan found = umb_fan();
    detail::throwing([&](status &result) { found = fan(vertex, index, result); });
    return found;
  }

 private:
  const umb_topology *handle_ = nullptr;
};

namespace detail {

struct destroy {
  void operator()(umb_topology *handle) const noexcept { umb_topology_destroy(handle); }
  void operator()(umb_cut *handle) const noexcept { umb_cut_destroy(handle); }
  void operator()(umb_segmentation *handle) const noexcept { umb_segmentation_destroy(handle); }
};
template <class Handle>
using owner = std::unique_ptr<Handle, destroy>;

}  // namespace detail

/**
 * The one-rings of a mesh, from its faces alone; kept while positions move. Reads as a `topology_view` does. Moves, does not copy; null once it
 * has been moved from.
 */
class topology : public topology_view {
 public:
  topology() noexcept = default;

  /** Builds the one-rings; see `umb_topology_create`. */
  topology(const faces &loops, std::size_t vertices, const topology_options &options = topology_options()) {
    detail::throwing([&](status &result) { *this = topology(loops, vertices, options, result); });
  }
  /** Likewise; null after a failure. */
  topology(const faces &loops, std::size_t vertices, const topology_options &options, status &result) noexcept {
    umb_topology *handle = nullptr;
    result.set(umb_topology_create(&loops, vertices, &options, &handle, result.room()));
    *this = topology(handle);
  }
  /** Takes a handle of C over. */
  explicit topology(umb_topology *handle) noexcept : topology_view(handle), owner_(handle) {}

  topology(topology &&other) noexcept : topology_view(std::exchange(other.view(), topology_view())), owner_(std::move(other.owner_)) {}
  topology &operator=(topology &&other) noexcept {
    if (this != &other) {
      view() = std::exchange(other.view(), topology_view());
      owner_ = std::move(other.owner_);
    }
    return *this;
  }

  /** Hands the handle of C over to the caller. */
  umb_topology *release() noexcept {
    view() = topology_view();
    return owner_.release();
  }

 private:
  topology_view &view() noexcept { return *this; }
  detail::owner<umb_topology> owner_;
};

/** A mesh cut open along its creases: see `umb_cut`. Moves, does not copy; empty once it has been moved from. */
class cut_mesh {
 public:
  cut_mesh() noexcept = default;

  /** Cuts; see `umb_cut_create`. */
  cut_mesh(const faces &loops, const points &positions, const creases &where = creases(),
           const topology_options &options = topology_options()) {
    detail::throwing([&](status &result) { build(loops, positions, where, options, result); });
  }
  /** Likewise; empty after a failure. */
  cut_mesh(const faces &loops, const points &positions, const creases &where, const topology_options &options,
           status &result) noexcept {
    build(loops, positions, where, options, result);
  }
  /** Takes a handle of C over. */
  explicit cut_mesh(umb_cut *handle) noexcept : handle_(handle) {}

  explicit operator bool() const noexcept { return handle_ != nullptr; }
  const umb_cut *get() const noexcept { return handle_.get(); }
  /** The topology of the cut mesh; lives as long as this. */
  topology_view topology() const noexcept { return topology_view(umb_cut_topology(get())); }
  /** The number of vertices of the cut mesh. */
  std::size_t vertex_count() const noexcept { return umb_cut_vertex_count(get()); }
  /** `#C`, the corners of ignored faces included. */
  std::size_t corner_count() const noexcept { return umb_cut_corner_count(get()); }
  /** The vertex of the cut mesh at each corner, `#C`. */
  span<const std::uint32_t> corners() const noexcept { return {umb_cut_corners(get()), corner_count()}; }
  /** The original vertex of each vertex of the cut mesh, ascending. */
  span<const std::uint32_t> origins() const noexcept { return {umb_cut_origins(get()), vertex_count()}; }
  /** Where the vertices of the cut mesh that come from each original vertex start, and the end of the last: `#V + 1`. */
  span<const std::uint32_t> starts() const noexcept {
    // Every original vertex has at least one, so the last of these comes from the last of those.
    const span<const std::uint32_t> from = origins();
    return {umb_cut_starts(get()), handle_ ? (from.empty() ? 0 : std::size_t{from[from.size() - 1]} + 1) + 1 : 0};
  }

 private:
  void build(const faces &loops, const points &positions, const creases &where, const topology_options &options,
             status &result) noexcept {
    umb_cut *handle = nullptr;
    result.set(umb_cut_create(&loops, &positions, &where, &options, &handle, result.room()));
    handle_.reset(handle);
  }
  detail::owner<umb_cut> handle_;
};

/** The faces of a mesh in segments: see `umb_segmentation`. Moves, does not copy; empty once it has been moved from. */
class segmentation {
 public:
  segmentation() noexcept = default;
  /** Takes a handle of C over. */
  explicit segmentation(umb_segmentation *handle) noexcept : handle_(handle) {}

  explicit operator bool() const noexcept { return handle_ != nullptr; }
  const umb_segmentation *get() const noexcept { return handle_.get(); }
  /** The number of segments. */
  std::size_t count() const noexcept { return umb_segmentation_count(get()); }
  /** `#F`, ignored ones included. */
  std::size_t face_count() const noexcept { return umb_segmentation_face_count(get()); }
  /** The label of each face, `#F`: below `count()`, or `UMB_NO_SEGMENT`. */
  span<const std::uint32_t> labels() const noexcept { return {umb_segmentation_labels(get()), face_count()}; }
  /** The edges between segments, two vertices each: `2 #E` numbers. */
  span<const std::uint32_t> boundary_edges() const noexcept {
    return {umb_segmentation_boundary_edges(get()), 2 * umb_segmentation_boundary_edge_count(get())};
  }

  /** The area of each segment, length^2, into `count()` numbers; see `umb_segmentation_areas`. */
  void areas(const faces &loops, const points &positions, span<double> into, status &result) const noexcept {
    result.set(umb_segmentation_areas(get(), &loops, &positions, into.data(), into.size(), result.room()));
  }
  std::vector<double> areas(const faces &loops, const points &positions) const {
    std::vector<double> found(count());
    detail::throwing([&](status &result) { areas(loops, positions, {found.data(), found.size()}, result); });
    return found;
  }

  /** The mean of a number over each segment, into `count()` numbers; see `umb_segmentation_means`. */
  void means(const faces &loops, const points &positions, const scalars &of, span<double> into, status &result) const noexcept {
    result.set(umb_segmentation_means(get(), &loops, &positions, &of, into.data(), into.size(), result.room()));
  }
  std::vector<double> means(const faces &loops, const points &positions, const scalars &of) const {
    std::vector<double> found(count());
    detail::throwing([&](status &result) { means(loops, positions, of, {found.data(), found.size()}, result); });
    return found;
  }

 private:
  detail::owner<umb_segmentation> handle_;
};

}  // namespace UMBILIC_VARIANT
}  // namespace umbilic

#endif  // UMBILIC_HANDLES_HPP
