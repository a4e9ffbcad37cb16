/*
 * Errors as exceptions and as values, and what tells the two variants of a program's parts apart. A part of umbilic.hpp, which says what holds for all.
 */
#ifndef UMBILIC_ERRORS_HPP
#define UMBILIC_ERRORS_HPP

#include <umbilic.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <system_error>
#include <string>

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

}  // namespace UMBILIC_VARIANT
}  // namespace umbilic

#endif  // UMBILIC_ERRORS_HPP
