#include "partitioned/schemes/robin_robin_corrected_stepper.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "fem/dimensions.hpp"
#include "partitioned/scheme_checks.hpp"
#include "scene/time_scheme.hpp"

namespace fsi {

namespace {

template <int n>
Case of_prediction(const Case& setup, const RobinRobinCorrected<n>& corrected) {
  Case predicting = setup;
  predicting.partitioned.robin_coefficient =
      RobinRobinCorrected<n>::factor_of_prediction * corrected.coefficient().value;
  return predicting;
}

}  // namespace

template <int n>
RobinRobinCorrectedStepper<n>::RobinRobinCorrectedStepper(Scene<n>& scene, const Loads& loads, const Case& setup,
                                                          const CouplingScheme& scheme)
    : RobinRobinCorrectedStepper(scene, loads, setup, scheme,
                                 std::make_unique<RobinRobinCorrected<n>>(scene, setup.partitioned)) {
  require_for_loose(scheme, setup, scene);
  if (const std::string name = time_scheme_of(setup, scene); name == "generalised-alpha")
    refuse_time_scheme(scheme, setup, name,
                       "what a jump of the load leaves is damped too little, and the correction drives it on: the "
                       "pressure rings",
                       "use \"bdf2\" or \"euler\", or another coupling scheme: \"robin-robin\"");
  require_scheme_for_one_pass(scheme, setup, scene);
}

template <int n>
RobinRobinCorrectedStepper<n>::RobinRobinCorrectedStepper(Scene<n>& scene, const Loads& loads, const Case& setup,
                                                          const CouplingScheme& scheme,
                                                          std::unique_ptr<RobinRobinCorrected<n>> problem)
    : Base(scene, loads, setup, scheme, std::move(problem)),
      corrected_(static_cast<RobinRobinCorrected<n>&>(Base::problem())),
      prediction_(scene, loads, of_prediction(setup, corrected_), scheme) {}

template <int n>
void RobinRobinCorrectedStepper<n>::begin_step(const State& state) {
  Base::begin_step(state);
  Base::report_.outer_iterations = prediction_.solve_step(state).outer_iterations;
  const RobinRobin<n>& predicted = prediction_.stepper().robin_robin();
  corrected_.correct_by(predicted.changes());
  corrected_.cost = predicted.cost;
  Base::report_.history.push_back(
      fmt::format("prediction    newton {} + {}", corrected_.cost.fluid_newton, corrected_.cost.wall_newton));
}

template <int n>
void RobinRobinCorrectedStepper<n>::finish_step(const State& state) {
  Base::finish_step(state);
  prediction_.finish_step();
}

template <int n>
void RobinRobinCorrectedStepper<n>::keep(RestartArchive& archive) {
  Base::keep(archive);
  prediction_.keep(archive);
}

#define FSI_INSTANTIATE(n) template class RobinRobinCorrectedStepper<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
