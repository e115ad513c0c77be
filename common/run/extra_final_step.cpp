#include "run/extra_final_step.hpp"

#include <utility>

#include "fem/dimensions.hpp"
#include "scene/time_axis.hpp"

namespace fsi {

namespace {

/// While it lives, the steps go on behind the end of the run, as those of a restart do.
class LongerAxis {
 public:
  LongerAxis(const Case& setup, const State& state, Loads& loads) : longer_(setup), loads_(loads), run_(loads.axis()) {
    longer_.time.value().end *= 2;
    TimeAxis axis(longer_);
    axis.go_on(run_.stretches(), state.step, state.time, run_.insertions());
    loads_.axis() = std::move(axis);
  }
  ~LongerAxis() { loads_.axis() = std::move(run_); }
  LongerAxis(const LongerAxis&) = delete;
  LongerAxis& operator=(const LongerAxis&) = delete;

 private:
  Case longer_;  // which the axis refers to
  Loads& loads_;
  TimeAxis run_;
};

}  // namespace

template <int n>
ExtraFinalStep extra_final_step(const Case& setup, const State& state, Loads& loads, StepController<n>& march) {
  const LongerAxis longer(setup, state, loads);
  ExtraFinalStep found{state, {}};
  found.report = march.step(found.state);
  return found;
}

#define FSI_INSTANTIATE(n) \
  template ExtraFinalStep extra_final_step<n>(const Case&, const State&, Loads&, StepController<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
