// Counts what C++ allocates in a program of one file; the library's own memory does not come from here.
#ifndef ALLOCATIONS_HPP
#define ALLOCATIONS_HPP

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::size_t> allocations{0}, allocated_bytes{0};
}

// Not inlined: gcc would see memory of new in the hands of free.
__attribute__((noinline)) void *operator new(std::size_t size) {
  allocations++;
  allocated_bytes += size;
  void *block = std::malloc(size > 0 ? size : 1);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
__attribute__((noinline)) void operator delete(void *block) noexcept { std::free(block); }
__attribute__((noinline)) void operator delete(void *block, std::size_t) noexcept { std::free(block); }

#endif
