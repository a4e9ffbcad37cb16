/*
 * Views: what calls read and write, in the caller's containers. A part of umbilic.hpp, which says what holds for all.
 */
#ifndef UMBILIC_VIEWS_HPP
#define UMBILIC_VIEWS_HPP

#include <umbilic/containers.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace umbilic {
inline namespace UMBILIC_VARIANT {

// ---- views to read ----

/**
 * Positions, or normals or directions where an option says so: `# x 3`, `float` or `double`, borrowed. From a container of vectors (see
 * `vector_traits`) or of scalars, three in a row for each, or from a row-major Eigen matrix or a block of one, with its strides. A flat array
 * whose length is no multiple of three is refused by the call (`UMB_ERROR_SIZE`), as is a matrix that has not three columns.
 */
struct points : umb_points {
  /** None. */
  points() noexcept : umb_points() {}

  /** As C has them. */
  points(const umb_points &view) noexcept : umb_points(view) {}

  /** `count` vectors of three scalars from `data` on, `stride` bytes apart, 0 if packed. */
  template <class Scalar, std::enable_if_t<detail::IS_SCALAR<Scalar>, int> = 0>
  points(const Scalar *data, std::size_t count, std::size_t stride = 0) noexcept
      : points(detail::strided{data, count, stride, detail::SCALAR<Scalar>}) {}

  /** `count` vectors from `data` on, in a row. */
  template <class Vector, std::enable_if_t<detail::IS_VECTOR<Vector, 3>, int> = 0>
  points(const Vector *data, std::size_t count) noexcept
      : points(detail::strided{data, count, sizeof(Vector), detail::SCALAR<typename vector_traits<Vector>::scalar>}) {}

  /** All of a container. */
  template <class Container, std::enable_if_t<detail::HOLDS_VECTORS<const Container, 3>, int> = 0>
  points(const Container &container) noexcept : points(detail::whole<3>(container)) {}

  /** A member of each element: a vector, or the first of three scalars in a row. */
  template <class Container, class Member, class Owner,
            std::enable_if_t<detail::IS_CONTIGUOUS<const Container> && detail::IS_VECTOR_MEMBER<Member, 3>, int> = 0>
  points(const Container &container, Member Owner::*member) noexcept : points(detail::by_member(container, member)) {}

  /** Three scalars in a row, `offset` bytes from the start of each element. */
  template <class Scalar, class Container>
  static points at_offset(const Container &container, std::size_t offset) noexcept {
    return points(detail::by_offset<Scalar>(container, offset));
  }

 private:
  explicit points(const detail::strided &found) noexcept : umb_points() {
    data = found.data;
    count = found.count;
    stride = found.stride;
    scalar = found.scalar;
  }
};

/** Numbers to read, one for each vertex or, with `UMB_AT_FACES`, for each face: `float` or `double`, borrowed. */
struct scalars : umb_scalars {
  /** None. */
  scalars() noexcept : umb_scalars() {}

  /** As C has them. */
  scalars(const umb_scalars &view) noexcept : umb_scalars(view) {}

  /** `count` numbers from `data` on, `stride` bytes apart, 0 if packed. */
  template <class Scalar, std::enable_if_t<detail::IS_SCALAR<Scalar>, int> = 0>
  scalars(const Scalar *data, std::size_t count, std::size_t stride = 0, umb_location location = UMB_AT_VERTICES) noexcept
      : scalars(detail::strided{data, count, stride, detail::SCALAR<Scalar>}, location) {}

  /** All of a container of scalars. */
  template <class Container, std::enable_if_t<detail::HOLDS_VECTORS<const Container, 1>, int> = 0>
  scalars(const Container &container, umb_location location = UMB_AT_VERTICES) noexcept
      : scalars(detail::whole<1>(container), location) {}

  /** A member of each element. */
  template <class Container, class Member, class Owner,
            std::enable_if_t<detail::IS_CONTIGUOUS<const Container> && detail::IS_SCALAR<std::remove_cv_t<Member>>, int> = 0>
  scalars(const Container &container, Member Owner::*member, umb_location location = UMB_AT_VERTICES) noexcept
      : scalars(detail::by_member(container, member), location) {}

 private:
  scalars(const detail::strided &found, umb_location at) noexcept : umb_scalars() {
    data = found.data;
    count = found.count;
    stride = found.stride;
    scalar = found.scalar;
    location = at;
  }
};

/** Bytes to read, `UMB_VERTEX_` bits or `UMB_SHAPE_` constants, as calls write them: std::uint8_t or std::byte, borrowed. */
struct bytes : umb_bytes {
  /** None. */
  bytes() noexcept : umb_bytes() {}

  /** As C has them. */
  bytes(const umb_bytes &view) noexcept : umb_bytes(view) {}

  /** `size` bytes from `first` on, `byte_stride` apart, 0 if packed. */
  bytes(const std::uint8_t *first, std::size_t size, std::size_t byte_stride = 0) noexcept : umb_bytes() {
    data = first;
    count = size;
    stride = byte_stride;
  }

  /** All of a container. */
  template <class Container, std::enable_if_t<detail::HOLDS_BYTES<const Container>, int> = 0>
  bytes(const Container &container) noexcept
      : bytes(reinterpret_cast<const std::uint8_t *>(std::data(container)), static_cast<std::size_t>(std::size(container))) {}

  /** A member of each element. */
  template <class Container, class Owner, std::enable_if_t<detail::IS_CONTIGUOUS<const Container>, int> = 0>
  bytes(const Container &container, std::uint8_t Owner::*member) noexcept : umb_bytes() {
    count = static_cast<std::size_t>(std::size(container));
    if (count > 0) data = std::addressof(std::data(container)->*member);
    stride = sizeof(typename detail::contiguous<const Container>::element);
  }
};

/** A polyline, `#V x 2` or `#V x 3`, borrowed. From a container of vectors, or of scalars with the dimension. */
struct polyline : umb_polyline {
  /** As C has it. */
  polyline(const umb_polyline &view) noexcept : umb_polyline(view) {}

  /** All of a container of vectors of two or three scalars; `is_closed`: the last point is joined to the first. */
  template <class Container, std::enable_if_t<(detail::HOLDS_VECTORS<const Container, 2> || detail::HOLDS_VECTORS<const Container, 3>)&&!detail::IS_SCALAR<
                                                  typename detail::contiguous<const Container>::element>,
                                              int> = 0>
  explicit polyline(const Container &container, bool is_closed = false) noexcept
      : polyline(detail::whole<vector_traits<typename detail::contiguous<const Container>::element>::size>(container),
                 vector_traits<typename detail::contiguous<const Container>::element>::size, is_closed) {}

  /** `point_count` points of `coordinates` (2 or 3) scalars from `first` on, `byte_stride` bytes apart, 0 if packed. */
  template <class Scalar, std::enable_if_t<detail::IS_SCALAR<Scalar>, int> = 0>
  polyline(const Scalar *first, std::size_t point_count, std::size_t coordinates, bool is_closed = false,
           std::size_t byte_stride = 0) noexcept
      : polyline(detail::strided{first, point_count, byte_stride, detail::SCALAR<Scalar>}, coordinates, is_closed) {}

 private:
  polyline(const detail::strided &found, std::size_t coordinates, bool is_closed) noexcept : umb_polyline() {
    data = found.data;
    count = found.count;
    stride = found.stride;
    scalar = found.scalar;
    dimension = static_cast<std::uint32_t>(coordinates);
    closed = is_closed ? 1 : 0;
  }
};

/**
 * Faces, `#F` loops of vertex indices (counter-clockwise seen from outside), borrowed. Indices are integers of 32 or 64 bits, in a row:
 * triangles or other faces of one size as a container of std::array or of integers, polygons as integers with offsets.
 */
struct faces : umb_faces {
  /** None. */
  faces() noexcept : umb_faces() {}

  /** As C has them. */
  faces(const umb_faces &view) noexcept : umb_faces(view) {}

  /** Faces of as many corners as each element has indices. */
  template <class Container,
            std::enable_if_t<detail::IS_INDEX<typename vector_traits<typename detail::contiguous<const Container>::element>::scalar>,
                             int> = 0>
  faces(const Container &container) noexcept : umb_faces() {
    using Element = typename detail::contiguous<const Container>::element;
    static_assert(sizeof(Element) == vector_traits<Element>::size * sizeof(typename vector_traits<Element>::scalar),
                  "indices are packed");
    take(static_cast<const typename vector_traits<Element>::scalar *>(static_cast<const void *>(std::data(container))),
         static_cast<std::size_t>(std::size(container)) * vector_traits<Element>::size);
    arity = static_cast<std::uint32_t>(vector_traits<Element>::size);
  }

  /** Triangles from a container of integers; from a matrix faces of as many corners as it has columns. */
  template <class Container,
            std::enable_if_t<detail::IS_INDEX<typename detail::contiguous<const Container>::element>, int> = 0>
  faces(const Container &container) noexcept : faces(container, columns(container)) {}

  /** Faces of `corners` corners each, from a container of integers. */
  template <class Container,
            std::enable_if_t<detail::IS_INDEX<typename detail::contiguous<const Container>::element>, int> = 0>
  faces(const Container &container, std::uint32_t corners) noexcept : umb_faces() {
    take(std::data(container), static_cast<std::size_t>(std::size(container)));
    arity = corners;
    if (index_count > 0 && !detail::is_packed(container, corners)) refuse();
  }

  /** Polygons: face `f` has the indices from `starts[f]` up to `starts[f + 1]`; both are of one integer type. */
  template <class Container, class Offsets,
            std::enable_if_t<detail::IS_INDEX<typename detail::contiguous<const Container>::element> &&
                                 std::is_same_v<typename detail::contiguous<const Container>::element,
                                                typename detail::contiguous<const Offsets>::element>,
                             int> = 0>
  faces(const Container &container, const Offsets &starts) noexcept : umb_faces() {
    take(std::data(container), static_cast<std::size_t>(std::size(container)));
    start(std::data(starts), static_cast<std::size_t>(std::size(starts)));
    if (!is_row(container) || !is_row(starts)) refuse();
  }

  /** `count` indices from `data` on, faces of `corners` corners each. */
  template <class Index, std::enable_if_t<detail::IS_INDEX<Index>, int> = 0>
  faces(const Index *data, std::size_t count, std::uint32_t corners = 3) noexcept : umb_faces() {
    take(data, count);
    arity = corners;
  }

  /** `count` indices from `data` on, and `polygon_count + 1` offsets. */
  template <class Index, std::enable_if_t<detail::IS_INDEX<Index>, int> = 0>
  faces(const Index *data, std::size_t count, const Index *starts, std::size_t polygon_count) noexcept : umb_faces() {
    take(data, count);
    start(starts, polygon_count + 1);
  }

  /** The number of faces, as far as the fields are right. */
  std::size_t size() const noexcept { return offsets ? face_count : index_count / (arity == 0 ? 3 : arity); }

 private:
  template <class Index>
  void take(const Index *data, std::size_t count) noexcept {
    indices = data;
    index_count = count;
    index = detail::INDEX<Index>;
  }
  void start(const void *starts, std::size_t count) noexcept {
    offsets = count == 0 ? nullptr : starts;
    // Without any offset there may be no index: else this number of faces is refused.
    face_count = count == 0 ? (index_count == 0 ? 0 : detail::NONE) : count - 1;
  }
  // C has no strides of indices: what is not in a row gets a number of faces that no offsets can have.
  void refuse() noexcept {
    offsets = indices;
    face_count = detail::NONE;
  }
  template <class Container>
  static bool is_row(const Container &container) noexcept {
    return !detail::IS_MATRIX<Container> && detail::is_packed(container, 0);
  }
  template <class Container>
  static std::uint32_t columns(const Container &container) noexcept {
    if constexpr (detail::IS_MATRIX<Container>) {
      return static_cast<std::uint32_t>(container.cols());
    } else {
      return 3;
    }
  }
};

/** Polygons that are not in a row, copied into one: 4 bytes for each corner and each face. */
class polygons {
 public:
  polygons() = default;
  polygons(const polygons &) = default;
  polygons &operator=(const polygons &) = default;
  /** Empty once it has been moved from. */
  polygons(polygons &&other) noexcept
      : indices_(std::exchange(other.indices_, {})),
        offsets_(std::exchange(other.offsets_, {})),
        face_count_(std::exchange(other.face_count_, 0)),
        triangles_(std::exchange(other.triangles_, true)) {}
  polygons &operator=(polygons &&other) noexcept {
    polygons taken(std::move(other));
    std::swap(indices_, taken.indices_);
    std::swap(offsets_, taken.offsets_);
    std::swap(face_count_, taken.face_count_);
    std::swap(triangles_, taken.triangles_);
    return *this;
  }

  /** From a range of ranges of indices: `std::vector<std::vector<int>>`. */
  template <class Range>
  explicit polygons(const Range &loops) {
    for (const auto &loop : loops) push_back(loop);
  }

  /** Adds a face. */
  template <class Loop>
  void push_back(const Loop &loop) {
    for (const auto index : loop) add_corner(static_cast<std::uint64_t>(index));
    end_face();
  }

  /** Adds a corner to the face that is not yet ended; what is beyond 32 bits is refused by the call. */
  void add_corner(std::uint64_t vertex) {
    constexpr std::uint32_t LAST = std::numeric_limits<std::uint32_t>::max();
    indices_.push_back(vertex < LAST ? static_cast<std::uint32_t>(vertex) : LAST);
  }
  void end_face() {
    const std::size_t begin = triangles_ ? 3 * face_count_ : offsets_.back();
    if (triangles_ && indices_.size() - begin != 3) {
      triangles_ = false;
      for (std::size_t face = 0; face <= face_count_; face++) offsets_.push_back(static_cast<std::uint32_t>(3 * face));
    }
    face_count_++;
    if (!triangles_) offsets_.push_back(static_cast<std::uint32_t>(indices_.size()));
  }
  void reserve(std::size_t corners) { indices_.reserve(corners); }

  /** The number of faces. */
  std::size_t size() const noexcept { return face_count_; }
  /** The number of corners of all faces. */
  std::size_t corner_count() const noexcept { return indices_.size(); }

  /** What calls take. */
  operator faces() const noexcept {
    return triangles_ ? faces(indices_.data(), indices_.size()) : faces(indices_, offsets_);
  }

 private:
  std::vector<std::uint32_t> indices_;
  std::vector<std::uint32_t> offsets_;  // none as long as all are triangles
  std::size_t face_count_ = 0;
  bool triangles_ = true;
};

// ---- views to write ----

/**
 * An output, borrowed: of vectors, `# x 3`, or of numbers, `#`; `float` or `double`. From a container as `points` are; it has to have an
 * element for each vertex (or face, corner, entry), else the call is refused with `UMB_ERROR_SIZE`. As constructed by default: not wanted.
 */
template <std::size_t Components>
struct output : umb_output {
  /** Not wanted. */
  output() noexcept : umb_output() {}

  /** As C has it; as long as the caller says. */
  output(const umb_output &view, std::size_t room = detail::NONE) noexcept : umb_output(view), count(room) {}

  /** `room` elements from `first` on, `byte_stride` bytes apart, 0 if packed. */
  template <class Scalar, std::enable_if_t<detail::IS_SCALAR<Scalar>, int> = 0>
  output(Scalar *first, std::size_t room, std::size_t byte_stride = 0) noexcept
      : output(detail::strided{first, room, byte_stride, detail::SCALAR<Scalar>}) {}

  /** `room` vectors from `first` on, in a row. */
  template <class Vector, std::enable_if_t<detail::IS_VECTOR<Vector, Components>, int> = 0>
  output(Vector *first, std::size_t room) noexcept
      : output(detail::strided{first, room, sizeof(Vector), detail::SCALAR<typename vector_traits<Vector>::scalar>}) {}

  /** All of a container. */
  template <class Container, std::enable_if_t<detail::HOLDS_VECTORS<std::remove_reference_t<Container>, Components> &&
                                                  detail::IS_TARGET<Container>,
                                              int> = 0>
  output(Container &&container) noexcept : output(detail::whole<Components>(container)) {}

  /** A member of each element. */
  template <class Container, class Member, class Owner,
            std::enable_if_t<detail::IS_TARGET<Container> && detail::IS_VECTOR_MEMBER<Member, Components> &&
                                 !std::is_const_v<Member>,
                             int> = 0>
  output(Container &&container, Member Owner::*member) noexcept : output(detail::by_member(container, member)) {}

  /** Scalars in a row, `offset` bytes from the start of each element. */
  template <class Scalar, class Container>
  static output at_offset(Container &container, std::size_t offset) noexcept {
    static_assert(detail::IS_WRITABLE<Container>, "an output can be written");
    return output(detail::by_offset<Scalar>(container, offset));
  }

  /** The number of elements that there is room for. */
  std::size_t count = detail::NONE;

 private:
  explicit output(const detail::strided &found) noexcept : umb_output(), count(found.count == detail::NONE ? 0 : found.count) {
    data = const_cast<void *>(found.data);
    stride = found.stride;
    scalar = found.scalar;
  }
};

/** `# x 3`. */
using vectors = output<3>;
/** `#`. */
using numbers = output<1>;

/** An output of bytes, `#`: std::uint8_t or std::byte. As constructed by default: not wanted. */
struct byte_output : umb_status_output {
  /** Not wanted. */
  byte_output() noexcept : umb_status_output() {}

  /** `room` bytes from `first` on, `byte_stride` apart, 0 if packed. */
  byte_output(std::uint8_t *first, std::size_t room, std::size_t byte_stride = 0) noexcept : umb_status_output(), count(room) {
    data = first;
    stride = byte_stride;
  }

  /** All of a container. */
  template <class Container, std::enable_if_t<detail::HOLDS_BYTES<std::remove_reference_t<Container>> &&
                                                  detail::IS_TARGET<Container>,
                                              int> = 0>
  byte_output(Container &&container) noexcept
      : byte_output(reinterpret_cast<std::uint8_t *>(std::data(container)), static_cast<std::size_t>(std::size(container))) {}

  /** A member of each element. */
  template <class Container, class Owner, std::enable_if_t<detail::IS_TARGET<Container>, int> = 0>
  byte_output(Container &&container, std::uint8_t Owner::*member) noexcept : umb_status_output() {
    count = static_cast<std::size_t>(std::size(container));
    if (count > 0) data = std::addressof(std::data(container)->*member);
    stride = sizeof(typename detail::contiguous<std::remove_reference_t<Container>>::element);
  }

  /** The number of elements that there is room for. */
  std::size_t count = detail::NONE;
};

/** Where vertex normals go: see `umb_normal_outputs`. */
struct normal_outputs {
  vectors normal{}, sum{};
  byte_output status{};
};

/** Where face normals go: see `umb_face_outputs`. */
struct face_outputs {
  vectors normal{}, area_vector{};
  byte_output status{};
};

/** Where curvatures go: see `umb_curvature_outputs`. */
struct curvature_outputs {
  numbers k1{}, k2{};
  vectors direction1{}, direction2{};
  numbers mean{}, gaussian{};
  vectors mean_normal{};
  numbers area{}, integrated_mean{}, integrated_gaussian{}, shape_index{}, curvedness{}, residual{}, condition{}, degrees_of_freedom{};
  vectors normal{};
  byte_output status{};
};

/** Where sections go: see `umb_section_outputs`. */
struct section_outputs {
  numbers curvature{};
  byte_output status{};
  vectors normal{};
};

/** Where curvatures of polylines go: see `umb_polyline_outputs`. */
struct polyline_outputs {
  numbers circle{}, parabola{}, length_parabola{}, symmetric_parabola{};
  byte_output status{};
};

/** Where corner normals go: see `umb_corner_outputs`. `corner` is `#C x 3`, the others go by vertex of the cut mesh. */
struct corner_outputs {
  vectors corner{}, normal{}, sum{};
  byte_output status{};
};

}  // namespace UMBILIC_VARIANT
}  // namespace umbilic

#endif  // UMBILIC_VIEWS_HPP
