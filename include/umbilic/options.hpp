/*
 * Options with their sizes set, and progress by any callable. A part of umbilic.hpp, which says what holds for all.
 */
#ifndef UMBILIC_OPTIONS_HPP
#define UMBILIC_OPTIONS_HPP

#include <umbilic/views.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iterator>
#include <memory>
#include <type_traits>

namespace umbilic {
inline namespace UMBILIC_VARIANT {

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

}  // namespace UMBILIC_VARIANT
}  // namespace umbilic

#endif  // UMBILIC_OPTIONS_HPP
