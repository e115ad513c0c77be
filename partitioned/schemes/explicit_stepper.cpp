#include "partitioned/schemes/explicit_stepper.hpp"

#include <fmt/format.h>

#include "fem/dimensions.hpp"
#include "partitioned/scheme_checks.hpp"
#include "partitioned/schemes/added_mass.hpp"

namespace fsi {

CouplingMethod one_pass_a_step() {
  return {"interface", "a step is one pass: fluid and wall, each solved by itself, nothing iterated"};
}

template <int n>
ExplicitStepper<n>::ExplicitStepper(Scene<n>& scene, const Loads& loads, const Case& setup,
                                    const CouplingScheme& scheme)
    : Base(scene, loads, setup, scheme), march_(scheme, setup.partitioned.velocity_gap), before_(march_) {
  require_moving_start(scheme, setup, Base::first_order());
  require_scheme_for_one_pass(scheme, setup, scene);
}

template <int n>
std::optional<CouplingMethod> ExplicitStepper<n>::coupling_method() const {
  return one_pass_a_step();
}

template <int n>
void ExplicitStepper<n>::finish_step(const State& state) {
  Base::finish_step(state);
  march_.finish(state.step);
}

template <int n>
void ExplicitStepper<n>::keep(RestartArchive& archive) {
  Base::keep(archive);
  march_.keep(archive);
}

template <int n>
void ExplicitStepper<n>::begin_stage(const State& state, const StepData& data) {
  if (state.step > 0 || data.rates.stage > 0 || data.rates.is_static()) return;
  const int order = Base::first_order();
  const double ratio = added_mass(Base::scene(), Base::problem(), Base::space(), order, state, data);
  Base::report_.history.push_back(fmt::format("added mass over the wall's answer: {:.3g}", ratio));
  march_.require_small(ratio, order, data.time);
}

template <int n>
void ExplicitStepper<n>::judge_pass(const State& state, const StepData& data) {
  march_.check(state.step + 1, data.time, Base::coupling(), Base::problem().movement());
}

template <int n>
void ExplicitStepper<n>::finish_stage(State&, const StepData&) {
  Base::problem().follow_wall();
}

#define FSI_INSTANTIATE(n) template class ExplicitStepper<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
