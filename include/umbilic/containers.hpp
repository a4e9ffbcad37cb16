/*
 * Which containers, and which types in them, are vectors of scalars in a row. A part of umbilic.hpp, which says what holds for all.
 */
#ifndef UMBILIC_CONTAINERS_HPP
#define UMBILIC_CONTAINERS_HPP

#include <umbilic/errors.hpp>

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

}  // namespace UMBILIC_VARIANT
}  // namespace umbilic

#endif  // UMBILIC_CONTAINERS_HPP
