// Lists of tasks in C++: those of a peer, any callable, and umbilic's to compare them with.
#ifndef UMBILIC_BENCHES_TASKS_H
#define UMBILIC_BENCHES_TASKS_H

#include "ours.h"
#include "program.h"

#include <deque>
#include <functional>
#include <memory>
#include <vector>

class Tasks {
public:
  explicit Tasks(const program &of) : p(of), ours(ours_new(&p.m, 0), ours_free) {}

  void add(const char *library, const char *name, const char *scalar, std::function<void()> run, double share = 1) {
    runs.push_back(std::move(run));
    const auto call = [](void *context) { (*static_cast<std::function<void()> *>(context))(); };
    tasks.push_back(task{library, name, scalar, "as built", 1, share, call, &runs.back()});
  }

  void add_ours(const char *name, umb_scalar scalar) {
    calls.push_back(ours_call{ours.get(), name, scalar, 1, UMB_SIMD_BEST});
    const char *const scalars[] = {"f32", "f64"};
    tasks.push_back(task{"umbilic", name, scalars[scalar], "best", 1, 1, ours_run_call, &calls.back()});
  }

  const umb_topology *topology() { return ours_topology(ours.get()); }

  // The normals or k1, in double precision.
  std::vector<double> result(const char *name, std::size_t width) {
    ours_run(ours.get(), name, UMB_SCALAR_F64, 0, UMB_SIMD_BEST);
    const double *values = static_cast<const double *>(ours_result(ours.get()));
    return std::vector<double>(values, values + width * p.m.vertex_count);
  }

  void time() const { time_tasks(&p.b, &p.m, tasks.data(), tasks.size()); }

private:
  const program &p;
  std::unique_ptr<::ours, void (*)(::ours *)> ours;
  // These stay where they are when more are added.
  std::deque<std::function<void()>> runs;
  std::deque<ours_call> calls;
  std::vector<task> tasks;
};

#endif
