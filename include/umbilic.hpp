/*
 * umbilic in C++17: the C interface of umbilic.h with handles that free themselves, views of the host's own containers, and errors
 * as exceptions or as values. Header only; link with umbilic.
 *
 *   std::vector<std::array<float, 3>> positions = ...;
 *   std::vector<std::array<std::uint32_t, 3>> triangles = ...;
 *   umbilic::topology mesh(triangles, positions.size());
 *   std::vector<std::array<float, 3>> normals(positions.size());
 *   umbilic::vertex_normals(mesh, positions, normals);                  // N_CM
 *   umbilic::curvature_outputs wanted;
 *   wanted.k1 = k1, wanted.k2 = k2;                                     // std::vector<double>
 *   umbilic::curvatures(mesh, positions, wanted);                       // adaptive jets
 *
 * What the functions compute, in which units and with which errors, is said in umbilic.h at the function of the same name; here
 * stands what is different. Views borrow: what they were made of has to live until the call returns. Nothing is copied or
 * allocated beyond what the C functions do, but where a function returns a std::vector.
 *
 * Errors. Every function comes twice: one throws `umbilic::error`; the other takes an `umbilic::status &` at the end, throws
 * nothing, and sets it. Those that allocate a std::vector, `shape_classes` by positions, and all of the headers for hosts only throw; a
 * `status` does not keep `polygons` and what else is copied from running out of memory. An output that is a container is checked for its length, which C cannot do (`UMB_ERROR_SIZE`). What a progress
 * callback throws passes through both, after the call has been cancelled. Without exceptions (`-fno-exceptions`) the
 * throwing forms end the process.
 *
 * Threads: as in C. A `const` handle may be used by any number of threads at once.
 */
#ifndef UMBILIC_HPP
#define UMBILIC_HPP

#include <umbilic.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
#define UMBILIC_EXCEPTIONS 1
#define UMBILIC_VARIANT with_exceptions
#else
#define UMBILIC_EXCEPTIONS 0
#define UMBILIC_VARIANT without_exceptions
#endif

namespace umbilic {
// A program may hold parts with and without exceptions: their functions differ, so their names do.
inline namespace UMBILIC_VARIANT {

// ---- errors ----

/** Thrown by every function that takes no `status`. `what()` says what, where, and what was expected. */
class error : public std::runtime_error {
 public:
  explicit error(const umb_error &cause) : std::runtime_error(cause.message), status_(cause.status), element_(cause.element) {}

  /** A `UMB_ERROR_` constant. */
  umb_status status() const noexcept { return status_; }

  /** The offending corner, face, vertex, byte or value, as `what()` says; `UMB_NO_ELEMENT` if there is none. */
  std::uint64_t element() const noexcept { return element_; }

  /** The same as a code of `umbilic::category()`. */
  std::error_code code() const noexcept;

 private:
  umb_status status_;
  std::uint64_t element_;
};

/**
 * What a call came to, where exceptions are not wanted; allocates nothing. As a condition it is true after a failure, like
 * std::error_code. Calls overwrite it, so that one will do for many.
 */
class status {
 public:
  status() noexcept { clear(); }

  /** Whether the call failed. */
  explicit operator bool() const noexcept { return error_.status != UMB_OK; }

  /** `UMB_OK` or a `UMB_ERROR_` constant. */
  umb_status value() const noexcept { return error_.status; }

  /** The offending element, as the message says; `UMB_NO_ELEMENT` if there is none. */
  std::uint64_t element() const noexcept { return error_.element; }

  /** What, where, and what was expected; empty after success. UTF-8, lives as long as this. */
  const char *message() const noexcept { return error_.message; }

  /** The same as a code of `umbilic::category()`. */
  std::error_code code() const noexcept;

  /** Success. */
  void clear() noexcept {
    error_ = umb_error();
    error_.struct_size = static_cast<std::uint32_t>(sizeof error_);
    error_.element = UMB_NO_ELEMENT;
  }

  /** A failure that this header finds; `message` is cut to 239 bytes. */
  void fail(umb_status value, const char *message, std::uint64_t element = UMB_NO_ELEMENT) noexcept {
    clear();
    error_.status = value;
    error_.element = element;
    std::snprintf(error_.message, sizeof error_.message, "%s", message);
  }

  /** Throws `error` after a failure, else does nothing. */
  void raise() const {
    if (error_.status == UMB_OK) return;
#if UMBILIC_EXCEPTIONS
    throw error(error_);
#else
    std::fprintf(stderr, "umbilic: %s\n", error_.message);
    std::abort();
#endif
  }

  /** For calls of the C interface: `status.set(umb_...(..., status.room()))`. */
  umb_error *room() noexcept {
    clear();
    return &error_;
  }
  void set(umb_status value) noexcept {
    if (value == UMB_OK) {
      clear();
    } else {
      error_.status = value;
    }
  }

 private:
  umb_error error_;
};

/** The category of `UMB_ERROR_` constants as std::error_code. */
inline const std::error_category &category() noexcept {
  struct umbilic_category final : std::error_category {
    const char *name() const noexcept override { return "umbilic"; }
    std::string message(int value) const override { return umb_status_string(static_cast<umb_status>(value)); }
    std::error_condition default_error_condition(int value) const noexcept override {
      if (value == UMB_ERROR_OUT_OF_MEMORY) return std::errc::not_enough_memory;
      if (value == UMB_ERROR_CANCELLED) return std::errc::operation_canceled;
      if (value > UMB_OK && value < UMB_ERROR_OUT_OF_MEMORY) return std::errc::invalid_argument;
      return std::error_condition(value, *this);
    }
  };
  static const umbilic_category instance;
  return instance;
}

inline std::error_code error::code() const noexcept { return {static_cast<int>(status_), category()}; }
inline std::error_code status::code() const noexcept { return {static_cast<int>(error_.status), category()}; }

// ---- the library ----

/** Whether the library that the program runs with has the binary interface of the header that it was built with. */
inline bool library_fits() noexcept { return umb_abi_version() == UMB_ABI_VERSION; }

// ---- spans: what a handle owns, to read ----

/** Elements in a row, in someone else's memory; a contiguous range, so std::span takes it. */
template <class T>
class span {
 public:
  using element_type = T;
  using value_type = std::remove_cv_t<T>;
  span() noexcept = default;
  span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
  T *data() const noexcept { return data_; }
  std::size_t size() const noexcept { return size_; }
  bool empty() const noexcept { return size_ == 0; }
  T *begin() const noexcept { return data_; }
  T *end() const noexcept { return data_ + size_; }
  T &operator[](std::size_t index) const noexcept { return data_[index]; }

 private:
  T *data_ = nullptr;
  std::size_t size_ = 0;
};

// ---- what a host's types are made of ----

/**
 * Which types are small vectors of scalars in a row. Known are std::array, arrays, types of three scalars with a `value_type`
 * (OpenMesh, Eigen), and structs of nothing but `x`, `y` and `z`. For others specialise it:
 *
 *   template <> struct umbilic::vector_traits<MyPoint> { using scalar = float; static constexpr std::size_t size = 3; };
 */
template <class T, class = void>
struct vector_traits {
  using scalar = void;
  static constexpr std::size_t size = 0;
};

namespace detail {

inline constexpr std::size_t NONE = std::numeric_limits<std::size_t>::max();

template <class T>
constexpr bool IS_SCALAR = std::is_same_v<T, float> || std::is_same_v<T, double>;

template <class T>
constexpr umb_scalar SCALAR = std::is_same_v<T, double> ? umb_scalar{UMB_SCALAR_F64} : umb_scalar{UMB_SCALAR_F32};

template <class T>
constexpr bool IS_INDEX = [] {
  if constexpr (std::is_integral_v<T>) {
    return sizeof(T) == 4 || sizeof(T) == 8;
  } else {
    return false;
  }
}();

// A negative index of 64 bits is, read as unsigned, as much out of range.
template <class T>
constexpr umb_index INDEX = sizeof(T) == 8             ? umb_index{UMB_INDEX_U64}
                            : std::is_signed_v<T> ? umb_index{UMB_INDEX_I32}
                                                  : umb_index{UMB_INDEX_U32};

template <class T, class = void>
struct nested_scalar {
  using type = void;
};
template <class T>
struct nested_scalar<T, std::void_t<typename T::value_type>> {
  using type = typename T::value_type;
};

template <class T, class = void>
constexpr bool IS_ITERATOR = false;
template <class T>
constexpr bool IS_ITERATOR<T, std::void_t<typename T::iterator_category>> = true;

// Held by value, not through a pointer as in a std::vector, whose size is that of three doubles.
template <class T>
constexpr bool HOLDS_ITS_SCALARS = std::is_trivially_destructible_v<T> && std::is_standard_layout_v<T> && !IS_ITERATOR<T>;

template <class T>
constexpr bool IS_STD_ARRAY = false;
template <class T, std::size_t N>
constexpr bool IS_STD_ARRAY<std::array<T, N>> = true;

template <class T>
constexpr bool HAS_THREE_VALUES = [] {
  using Scalar = typename nested_scalar<T>::type;
  if constexpr ((IS_SCALAR<Scalar> || IS_INDEX<Scalar>)&&!IS_STD_ARRAY<T>) {
    return sizeof(T) == 3 * sizeof(Scalar) && HOLDS_ITS_SCALARS<T>;
  } else {
    return false;
  }
}();

template <class T, class = void>
struct coordinates {
  using scalar = void;
};
template <class T>
struct coordinates<T, std::void_t<decltype(&T::x), decltype(&T::y), decltype(&T::z)>> {
  template <class Value>
  static Value member(Value T::*);
  static void member(...);
  using scalar = decltype(member(&T::x));
};

template <class T>
constexpr bool HAS_COORDINATES = [] {
  using Scalar = typename coordinates<T>::scalar;
  if constexpr (IS_SCALAR<Scalar>) {
    return sizeof(T) == 3 * sizeof(Scalar) && HOLDS_ITS_SCALARS<T> && offsetof(T, x) == 0 &&
           offsetof(T, y) == sizeof(Scalar);
  } else {
    return false;
  }
}();

}  // namespace detail

template <class T, std::size_t N>
struct vector_traits<std::array<T, N>> {
  using scalar = T;
  static constexpr std::size_t size = N;
};
template <class T, std::size_t N>
struct vector_traits<T[N]> {
  using scalar = T;
  static constexpr std::size_t size = N;
};
template <class T>
struct vector_traits<T, std::enable_if_t<detail::HAS_THREE_VALUES<T>>> {
  using scalar = typename T::value_type;
  static constexpr std::size_t size = 3;
};
template <class T>
struct vector_traits<T, std::enable_if_t<!detail::HAS_THREE_VALUES<T> && detail::HAS_COORDINATES<T>>> {
  using scalar = typename detail::coordinates<T>::scalar;
  static constexpr std::size_t size = 3;
};

namespace detail {

// The elements of anything with data() and size(), and of arrays; not those of matrices that are stored column by column.
template <class Container, class = void>
struct contiguous {
  static constexpr bool value = false;
};
// Eigen's, whose elements need not lie in a row: they say how far apart they are.
template <class Container, class = void>
constexpr bool IS_EIGEN = false;
template <class Matrix>
constexpr bool IS_EIGEN<Matrix, std::void_t<decltype(Matrix::IsRowMajor), decltype(Matrix::IsVectorAtCompileTime)>> = true;
template <class Container>
constexpr bool IS_MATRIX = [] {
  if constexpr (IS_EIGEN<Container>) {
    return !bool(Container::IsVectorAtCompileTime);
  } else {
    return false;
  }
}();
template <class Container>
constexpr bool IS_BY_ROWS = [] {
  if constexpr (IS_MATRIX<Container>) {
    return bool(Container::IsRowMajor);
  } else {
    return true;
  }
}();
// A matrix that can have N columns; the others may be anything.
template <class Container, std::size_t N>
constexpr bool MAY_HAVE_COLUMNS = [] {
  if constexpr (IS_MATRIX<Container>) {
    return int(Container::ColsAtCompileTime) == int(N) || int(Container::ColsAtCompileTime) < 0;
  } else {
    return true;
  }
}();
// Whether all elements lie in a row, by the type alone.
template <class Container>
constexpr bool IS_PACKED = [] {
  if constexpr (IS_MATRIX<Container>) {
    return false;
  } else if constexpr (IS_EIGEN<Container>) {
    return int(Container::InnerStrideAtCompileTime) == 1;
  } else {
    return true;
  }
}();
// Whether all elements lie in a row, those of a matrix `columns` in each.
template <class Container>
bool is_packed(const Container &container, std::size_t columns) noexcept {
  if constexpr (IS_MATRIX<std::remove_cv_t<Container>>) {
    return container.innerStride() == 1 && static_cast<std::size_t>(container.cols()) == columns &&
           (container.outerStride() == container.cols() || container.rows() < 2);
  } else if constexpr (IS_EIGEN<std::remove_cv_t<Container>>) {
    return container.innerStride() == 1;
  } else {
    return true;
  }
}
template <class Container>
struct contiguous<Container, std::void_t<decltype(*std::data(std::declval<Container &>())),
                                         decltype(std::size(std::declval<Container &>())),
                                         std::enable_if_t<IS_BY_ROWS<std::remove_cv_t<Container>>>>> {
  using pointer = decltype(std::data(std::declval<Container &>()));
  using pointed = std::remove_pointer_t<pointer>;
  using element = std::remove_cv_t<pointed>;
  static constexpr bool writable = !std::is_const_v<pointed>;
  static constexpr bool value = std::is_pointer_v<pointer>;
};

template <class Container>
constexpr bool IS_CONTIGUOUS = contiguous<Container>::value;
template <class Container>
constexpr bool IS_WRITABLE = [] {
  if constexpr (IS_CONTIGUOUS<Container>) {
    return contiguous<Container>::writable;
  } else {
    return false;
  }
}();

// A span, which may be gone before what it shows.
template <class Container, class = void>
constexpr bool IS_VIEW = false;
template <class Container>
constexpr bool IS_VIEW<Container, std::void_t<typename Container::element_type>> = true;

// An output has to be there after the call: a temporary view may go, but not a container of its own memory.
template <class Container, class = void>
constexpr bool OUTLIVES = true;
template <class Container>
constexpr bool OUTLIVES<Container, std::void_t<typename Container::allocator_type>> = false;
template <class Container>
constexpr bool IS_TARGET = IS_WRITABLE<std::remove_reference_t<Container>> && OUTLIVES<Container>;

// T is a vector of N scalars, or, for N = 1, a scalar.
template <class T, std::size_t N>
constexpr bool IS_VECTOR = vector_traits<T>::size == N && IS_SCALAR<typename vector_traits<T>::scalar>;

template <class Container, std::size_t N>
constexpr bool HOLDS_VECTORS = [] {
  if constexpr (IS_CONTIGUOUS<Container>) {
    using Element = typename contiguous<Container>::element;
    return (IS_SCALAR<Element> || IS_VECTOR<Element, N>)&&MAY_HAVE_COLUMNS<std::remove_cv_t<Container>, N>;
  } else {
    return false;
  }
}();

// A member that is a vector, or the first scalar of one.
template <class Member, std::size_t N>
constexpr bool IS_VECTOR_MEMBER = IS_SCALAR<std::remove_cv_t<Member>> || IS_VECTOR<std::remove_cv_t<Member>, N>;

template <class Member>
using member_scalar = typename std::conditional_t<IS_SCALAR<std::remove_cv_t<Member>>, vector_traits<std::array<std::remove_cv_t<Member>, 1>>,
                                                  vector_traits<std::remove_cv_t<Member>>>::scalar;

struct strided {
  const void *data = nullptr;
  std::size_t count = 0;
  std::size_t stride = 0;
  umb_scalar scalar = UMB_SCALAR_F32;
};

// What of Eigen's is N scalars in a row, again and again; else NONE elements. A stride of 0 or less cannot be said in C.
template <std::size_t N, class Container>
void spread(const Container &container, strided &found) noexcept {
  using Element = typename contiguous<const Container>::element;
  const auto inner = container.innerStride();
  if constexpr (IS_MATRIX<std::remove_cv_t<Container>>) {
    const auto outer = container.outerStride();
    const bool is_right = container.cols() == static_cast<decltype(container.cols())>(N) && (inner == 1 || N == 1) &&
                          (outer > 0 || container.rows() < 2);
    found.count = is_right ? static_cast<std::size_t>(container.rows()) : NONE;
    found.stride = outer > 0 ? static_cast<std::size_t>(outer) * sizeof(Element) : 0;
  } else {
    const bool is_right = inner == 1 || (inner > 0 && N == 1) || container.size() < 2;
    found.count = is_right && found.count % N == 0 ? found.count / N : NONE;
    found.stride = (N == 1 && inner > 0 ? static_cast<std::size_t>(inner) : N) * sizeof(Element);
  }
}

// A flat array that is no multiple of N scalars has NONE elements.
template <std::size_t N, class Container>
strided whole(Container &container) noexcept {
  using Element = typename contiguous<Container>::element;
  strided found;
  found.data = std::data(container);
  found.count = static_cast<std::size_t>(std::size(container));
  if constexpr (IS_EIGEN<std::remove_cv_t<Container>>) {
    static_assert(IS_SCALAR<Element>, "matrices are of float or double");
    spread<N>(container, found);
    found.scalar = SCALAR<Element>;
  } else if constexpr (IS_SCALAR<Element>) {
    found.count = found.count % N == 0 ? found.count / N : NONE;
    found.stride = N * sizeof(Element);
    found.scalar = SCALAR<Element>;
  } else {
    found.stride = sizeof(Element);
    found.scalar = SCALAR<typename vector_traits<Element>::scalar>;
  }
  return found;
}

template <class Container, class Member, class Owner>
strided by_member(Container &container, Member Owner::*member) noexcept {
  static_assert(IS_PACKED<std::remove_cv_t<Container>>, "elements are in a row");
  strided found;
  found.count = static_cast<std::size_t>(std::size(container));
  if (found.count > 0) found.data = std::addressof(std::data(container)->*member);
  found.stride = sizeof(typename contiguous<Container>::element);
  found.scalar = SCALAR<member_scalar<Member>>;
  return found;
}

template <class Scalar, class Container>
strided by_offset(Container &container, std::size_t offset) noexcept {
  static_assert(IS_SCALAR<Scalar>, "scalars are float or double");
  static_assert(IS_PACKED<std::remove_cv_t<Container>>, "elements are in a row");
  strided found;
  found.count = static_cast<std::size_t>(std::size(container));
  if (found.count > 0) found.data = reinterpret_cast<const unsigned char *>(std::data(container)) + offset;
  found.stride = sizeof(typename contiguous<Container>::element);
  found.scalar = SCALAR<Scalar>;
  return found;
}

// What an empty list points to, where null would mean something else.
inline const std::uint32_t *no_indices() noexcept {
  static const std::uint32_t nothing = 0;
  return &nothing;
}

// A list of 32-bit numbers.
template <class Container>
constexpr bool HOLDS_NUMBERS = [] {
  if constexpr (IS_CONTIGUOUS<Container>) {
    return std::is_same_v<typename contiguous<Container>::element, std::uint32_t> && IS_PACKED<std::remove_cv_t<Container>>;
  } else {
    return false;
  }
}();
template <class Container>
constexpr bool HOLDS_BYTES = [] {
  if constexpr (IS_CONTIGUOUS<Container>) {
    using Element = typename contiguous<Container>::element;
    return (std::is_same_v<Element, std::uint8_t> || std::is_same_v<Element, std::byte>)&&IS_PACKED<std::remove_cv_t<Container>>;
  } else {
    return false;
  }
}();

}  // namespace detail

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

// ---- progress ----

/**
 * A reference to a callable that takes the fraction done, 0 to 1, and answers `bool`, whether to go on; one without an answer always goes on. It is
 * called on the calling thread. The callable has to outlive the call, so temporaries are not taken. If it throws, the call is cancelled, and
 * goes on throwing once the library has returned.
 */
class progress_reference {
  // Other answers than bool, such as C's 0 for going on, would be misread.
  template <class Callable>
  static constexpr bool fits() noexcept {
    if constexpr (std::is_same_v<std::remove_cv_t<Callable>, progress_reference>) {
      return false;
    } else if constexpr (std::is_invocable_v<Callable &, double>) {
      using Answer = std::remove_cv_t<std::remove_reference_t<std::invoke_result_t<Callable &, double>>>;
      return std::is_void_v<Answer> || std::is_same_v<Answer, bool>;
    } else {
      return false;
    }
  }

 public:
  progress_reference() noexcept = default;
  template <class Callable, std::enable_if_t<fits<Callable>(), int> = 0>
  progress_reference(Callable &callable) noexcept : call_(&call<Callable>) {
    if constexpr (std::is_function_v<Callable>) {
      callable_.function = reinterpret_cast<void (*)()>(&callable);
    } else {
      callable_.object = const_cast<void *>(static_cast<const void *>(std::addressof(callable)));
    }
  }
  explicit operator bool() const noexcept { return call_ != nullptr; }
  bool operator()(double fraction) const { return call_(callable_, fraction); }

 private:
  union target {
    void *object = nullptr;
    void (*function)();
  };
  template <class Callable>
  static bool call(target which, double fraction) {
    Callable *callable;
    if constexpr (std::is_function_v<Callable>) {
      callable = reinterpret_cast<Callable *>(which.function);
    } else {
      callable = static_cast<Callable *>(which.object);
    }
    if constexpr (std::is_void_v<std::invoke_result_t<Callable &, double>>) {
      (*callable)(fraction);
      return true;
    } else {
      return (*callable)(fraction);
    }
  }
  target callable_;
  bool (*call_)(target, double) = nullptr;
};

// ---- options: the structs of C with their size set, all else zero ----

namespace detail {

template <class Struct>
struct sized : Struct {
  sized() noexcept : Struct() { this->struct_size = static_cast<std::uint32_t>(sizeof(Struct)); }
};

template <class Struct>
struct runnable : sized<Struct> {
  using plain = Struct;
  /** Beside `run.progress`, which it takes the place of. */
  progress_reference progress;
};

template <class Struct>
struct listing : runnable<Struct> {
  /** The vertices to compute, a container of std::uint32_t that has to live until the call; an empty one means none. */
  template <class Container>
  void only(const Container &vertices) noexcept {
    static_assert(HOLDS_NUMBERS<const Container>, "vertices are std::uint32_t in a row");
    this->run.vertices = std::size(vertices) == 0 ? no_indices() : std::data(vertices);
    this->run.vertex_count = static_cast<std::size_t>(std::size(vertices));
  }
  template <class Container, std::enable_if_t<!IS_VIEW<Container>, int> = 0>
  void only(const Container &&) = delete;
};

}  // namespace detail

/** See `umb_topology_options`. */
struct topology_options : detail::sized<umb_topology_options> {};

/** See `umb_adaptive_model`. */
struct adaptive_model : detail::sized<umb_adaptive_model> {};

/** See `umb_normal_options`: N_CM, or another weight. */
struct normal_options : detail::listing<umb_normal_options> {
  normal_options(umb_weight which = UMB_WEIGHT_CONFORMAL) noexcept { weight = which; }
};

/** See `umb_face_options`. */
struct face_options : detail::runnable<umb_face_options> {};

/** See `umb_curvature_options`: adaptive jets, or another method. */
struct curvature_options : detail::listing<umb_curvature_options> {
  curvature_options(umb_curvature_method which = UMB_CURVATURE_ADAPTIVE_JET) noexcept { method = which; }
};

/** See `umb_section_options`. */
struct section_options : detail::listing<umb_section_options> {
  section_options(umb_section which = UMB_SECTION_SYMMETRIC_PARABOLA) noexcept { section = which; }
};

/** See `umb_polyline_options`. */
struct polyline_options : detail::runnable<umb_polyline_options> {};

/** See `umb_creases`: edges sharper than `radians`; 0 for pi/6, or for none beside edges or groups that are marked. */
struct creases : detail::sized<umb_creases> {
  creases() noexcept = default;
  template <class Angle, std::enable_if_t<std::is_floating_point_v<Angle>, int> = 0>
  creases(Angle radians) noexcept {
    angle = static_cast<double>(radians);
  }
  /** Constants of C are integers: a weight is no angle. */
  template <class Constant, std::enable_if_t<std::is_integral_v<Constant> || std::is_enum_v<Constant>, int> = 0>
  creases(Constant) = delete;

  /** Marks edges: two std::uint32_t each, as pairs (std::array) or in a flat container. */
  template <class Container>
  void mark(const Container &pairs) noexcept {
    using Element = typename detail::contiguous<const Container>::element;
    const auto count = static_cast<std::size_t>(std::size(pairs));
    if constexpr (std::is_same_v<Element, std::uint32_t>) {
      edges = std::data(pairs);
      // An odd number is refused, and what is not in a row.
      edge_count = count % 2 == 0 && (count == 0 || detail::is_packed(pairs, 2)) ? count / 2 : detail::NONE;
    } else {
      static_assert(std::is_same_v<typename vector_traits<Element>::scalar, std::uint32_t> && vector_traits<Element>::size == 2,
                    "edges are pairs of std::uint32_t");
      edges = static_cast<const std::uint32_t *>(static_cast<const void *>(std::data(pairs)));
      edge_count = count;
    }
  }
  template <class Container, std::enable_if_t<!detail::IS_VIEW<Container>, int> = 0>
  void mark(const Container &&) = delete;

  /** Smoothing groups: a std::uint32_t for each face. */
  template <class Container>
  void group(const Container &face_groups) noexcept {
    static_assert(detail::HOLDS_NUMBERS<const Container>, "groups are std::uint32_t in a row");
    groups = std::size(face_groups) == 0 ? detail::no_indices() : std::data(face_groups);
    group_count = static_cast<std::size_t>(std::size(face_groups));
  }
  template <class Container, std::enable_if_t<!detail::IS_VIEW<Container>, int> = 0>
  void group(const Container &&) = delete;
};

/** See `umb_moved`: a container of std::uint32_t. */
struct moved : detail::sized<umb_moved> {
  template <class Container>
  explicit moved(const Container &which) noexcept {
    static_assert(detail::HOLDS_NUMBERS<const Container>, "vertices are std::uint32_t in a row");
    vertices = std::size(which) == 0 ? detail::no_indices() : std::data(which);
    vertex_count = static_cast<std::size_t>(std::size(which));
  }

  /** Likewise, with the statuses of the results as they were, a byte for each vertex: lists get shorter. */
  template <class Container>
  moved(const Container &which, const bytes &statuses) noexcept : moved(which) {
    status = statuses;
  }
};

/** See `umb_shape_options`. Point `points` at an `umbilic::points` that has to live until the call, or use the form that takes positions. */
struct shape_options : detail::runnable<umb_shape_options> {};

/** See `umb_feature_options`: cut along creases. Point `creases` at what has to live until the call. */
struct feature_options : detail::runnable<umb_feature_options> {};

/** See `umb_watershed_options`. Point `height` at an `umbilic::scalars` that has to live until the call. */
struct watershed_options : detail::runnable<umb_watershed_options> {};

/** See `umb_region_options`. Point `creases` at what has to live until the call. */
struct region_options : detail::runnable<umb_region_options> {};

namespace detail {

// Carries a callable past the C frames, and what it throws back.
struct relay {
  progress_reference progress;
#if UMBILIC_EXCEPTIONS
  std::exception_ptr thrown;
#endif

  static int call(void *user, double fraction) noexcept {
    relay &self = *static_cast<relay *>(user);
#if UMBILIC_EXCEPTIONS
    // After a throw the call is on its way out.
    if (self.thrown) return 1;
    try {
      return self.progress(fraction) ? 0 : 1;
    } catch (...) {
      self.thrown = std::current_exception();
      return 1;
    }
#else
    return self.progress(fraction) ? 0 : 1;
#endif
  }
};

// Runs a call with the options as C has them.
template <class Options, class Call>
void run(const Options &options, status &result, Call call) {
  typename Options::plain plain = options;
  relay relayed;
  relayed.progress = options.progress;
  if (options.progress) {
    plain.run.progress = &relay::call;
    plain.run.user = &relayed;
  }
  result.set(call(&plain, result.room()));
#if UMBILIC_EXCEPTIONS
  if (relayed.thrown) std::rethrow_exception(relayed.thrown);
#endif
}

template <class Output>
bool fits(const Output &wanted, std::size_t needed, const char *name, status &result) noexcept {
  if (wanted.count >= needed) return true;
  char message[160];
  std::snprintf(message, sizeof message, "the output `%s` has %llu elements, where %llu are needed", name,
                static_cast<unsigned long long>(wanted.count), static_cast<unsigned long long>(needed));
  result.fail(UMB_ERROR_SIZE, message, wanted.count);
  return false;
}

// Calls `attempt` with a status and throws what it says.
template <class Attempt>
void throwing(Attempt attempt) {
  status result;
  attempt(result);
  result.raise();
}

}  // namespace detail

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

#endif  // UMBILIC_HPP
