#include "system/step_continuation.hpp"

#include <algorithm>
#include <vector>

namespace fsi {

namespace {

constexpr double first_stride = 0.25, shortest_stride = 0.02;
constexpr double growth = 1.5, cut = 0.4;

/// x = a + factor (a - b)
void extrapolate(const std::vector<double>& a, const std::vector<double>& b, double factor, std::vector<double>& x) {
  x.resize(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) x[i] = a[i] + factor * (a[i] - b[i]);
}

}  // namespace

StepWalk walk_to_step(Solution& now, const std::function<bool(double share)>& solve) {
  StepWalk walk;
  Solution last = now, before = now;
  double at_before = 0, stride = first_stride;
  while (!walk.arrived() && stride >= shortest_stride) {
    const double to = std::min(1.0, walk.solved + stride);
    const double factor = walk.solved > 0 ? (to - walk.solved) / (walk.solved - at_before) : 0;
    now = last;
    extrapolate(last.mesh, before.mesh, factor, now.mesh);
    extrapolate(last.fluid, before.fluid, factor, now.fluid);
    extrapolate(last.wall, before.wall, factor, now.wall);
    ++walk.lengths_tried;
    if (!solve(to)) {
      walk.failed = to;
      stride = cut * (to - walk.solved);
      continue;
    }
    std::swap(before, last);
    last = now;
    at_before = walk.solved;
    walk.solved = to;
    stride *= growth;
    if (walk.failed <= walk.solved) walk.failed = 0;
  }
  now = last;
  return walk;
}

}  // namespace fsi
