#include "partitioned/block_newton/block_newton_stepper.hpp"

#include <fmt/format.h>

#include <utility>

#include "fem/dimensions.hpp"

namespace fsi {

namespace {

NewtonOptions newton_options(const Case& setup) {
  NewtonOptions options = setup.newton;
  if (setup.partitioned.tolerance) options.error_tolerance = *setup.partitioned.tolerance;
  return options;
}

}  // namespace

template <int n>
BlockNewtonStepper<n>::BlockNewtonStepper(Scene<n>& scene, const Loads& loads, const Case& setup,
                                          const CouplingScheme& scheme)
    : NewtonStepperBase<n>(scene, loads, newton_options(setup)),
      stiffness_(robin_stiffness(setup, scene)),
      choices_{{"partitioned.scheme", std::string(scheme.name),
                fmt::format("{}; its Robin condition is {:g} times the membrane's, as {}",
                            chosen_scheme(setup, scene).reason, stiffness_.factor, stiffness_.reason)}},
      problem_(scene, setup.partitioned, stiffness_.factor) {
  if (const std::string decision = problem_.linear_decision(); !decision.empty())
    choices_.push_back({"linear.direct_below", "by the wall", decision});
  if (setup.partitioned.tolerance) return;
  for (auto& stop : this->stopping()) choices_.push_back(std::move(stop));
}

template <int n>
std::optional<CouplingMethod> BlockNewtonStepper<n>::coupling_method() const {
  return CouplingMethod{
      "block",
      "one Newton iteration for both media, which needs both Jacobians; a pass, of its linear systems, is "
      "one cycle of each medium's preconditioner where both iterate, else one linear solve of each"};
}

template <int n>
StepReport BlockNewtonStepper<n>::advance(State& state) {
  problem_.cost = {};
  return NewtonStepperBase<n>::advance(state);
}

template <int n>
NewtonProblem& BlockNewtonStepper<n>::equations(State& state, StepData& data) {
  problem_.work_on(state, data);
  return problem_;
}

template <int n>
void BlockNewtonStepper<n>::finish_stage(const State&, const StepData&) {
  const BlockNewtonCost& cost = problem_.cost;
  CouplingReport coupling;
  coupling.columns = problem_.columns();
  coupling.displacement_residual = problem_.relative_gap();
  coupling.displacement_gap = problem_.gap();
  coupling.force_residual = problem_.relative_residual();
  coupling.pressure_residual = problem_.relative_pressure();
  coupling.gap_pressure = problem_.gap_pressure();
  coupling.fluid_newton_iterations = coupling.wall_newton_iterations = cost.newton_iterations;
  coupling.fluid_linear_iterations = cost.fluid_linear;
  coupling.wall_linear_iterations = cost.wall_linear;
  coupling.fluid_seconds = cost.fluid_seconds;
  coupling.wall_seconds = cost.wall_seconds;
  coupling.algebra_seconds = cost.algebra_seconds;
  StepReport& report = this->report_;
  report.outer_iterations = cost.passes;
  report.coupling = coupling;
  report.history.push_back(fmt::format("passes {}  |d~ - d| / |d~| = {:.3e}  pressure {:.3e}  columns {}", cost.passes,
                                       coupling.displacement_residual, coupling.pressure_residual, coupling.columns));
}

#define FSI_INSTANTIATE(n) template class BlockNewtonStepper<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
