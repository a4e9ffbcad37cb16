/*
 * For the programs that time umbilic in a host's terms: one line for each quantity, tab-separated,
 *
 *   host  quantity  copies  library_ms  adapter_ms
 *
 * `copies` are those of faces for a topology, else of positions and results; the library's time is that of the calls of the C interface
 * alone on the same arrays, the adapter's that of the whole call less it. Both take turns; the shortest of all rounds counts.
 */
#ifndef HOST_HPP
#define HOST_HPP

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>

namespace host {

template <class Call>
double milliseconds(const Call &call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

template <class Library, class Whole>
void report(const char *name, const char *quantity, const char *copies, const Library &library, const Whole &whole) {
  double shortest[2] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  double total = 0;
  for (int round = 0; round < 7 || (total < 3000 && round < 100); round++) {
    const double times[2] = {milliseconds(library), milliseconds(whole)};
    for (int k = 0; k < 2; k++) shortest[k] = std::min(shortest[k], times[k]);
    total += times[0] + times[1];
  }
  std::printf("%s\t%s\t%s\t%.4f\t%.4f\n", name, quantity, copies, shortest[0], shortest[1] - shortest[0]);
}

}  // namespace host

#endif  // HOST_HPP
