#include "system/newton_stepper.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "system/level_check.hpp"
#include "time/predictor.hpp"

namespace fsi {

void append_history(const NewtonReport& report, std::vector<std::string>& lines, const std::string& indent) {
  int k = 0;
  for (const auto& it : report.iterations)
    lines.push_back(
        fmt::format("{}newton {:2d}  increment {:.3e}  residual {:.3e}{}{}{}", indent, ++k, it.increment, it.residual,
                    it.linear_iterations > 0 ? fmt::format("  linear {}", it.linear_iterations) : "",
                    it.step < 1 ? fmt::format("  step {:g}", it.step) : "", it.linearised ? "  new jacobian" : ""));
}

void remember(const std::string& name, const LinearisationPoint& point, Memory& memory) {
  memory.arrays[name + ".mesh"] = point.now.mesh;
  memory.arrays[name + ".flow"] = point.now.fluid;
  memory.arrays[name + ".wall"] = point.now.wall;
  memory.arrays[name + ".mesh_reference"] = point.rates.mesh_reference;
  memory.arrays[name + ".flow_reference"] = point.rates.fluid_reference;
  if (!point.support_loads.empty()) memory.arrays[name + ".support_loads"] = point.support_loads;
  if (!point.opening_pressures.empty()) {
    memory.arrays[name + ".opening_pressures"] = point.opening_pressures;
    if (!point.rates.openings_reference.empty()) memory.arrays[name + ".windkessels"] = point.rates.openings_reference;
    if (!point.now.openings.empty()) memory.arrays[name + ".opening_values"] = point.now.openings;
  }
  memory.numbers[name + ".step"] = point.rates.step;
  memory.numbers[name + ".period"] = point.rates.interface.period;
  memory.numbers[name + ".flow_factor"] = point.rates.fluid_factor;
  memory.numbers[name + ".acceleration_factor"] = point.rates.acceleration_factor;
  memory.numbers[name + ".wall_pressure"] = point.wall_pressure;
}
bool recall(const std::string& name, const Memory& memory, LinearisationPoint& point) {
  if (memory.step_changed) return false;
  if (memory.numbers.count(name + ".step") == 0) return false;
  const auto array = [&](const char* part) {
    const auto found = memory.arrays.find(name + part);
    return found == memory.arrays.end() ? std::vector<double>() : found->second;
  };
  const auto number = [&](const char* part) { return memory.numbers.at(name + part); };
  point.now = {array(".mesh"), array(".flow"), array(".wall")};
  point.rates.mesh_reference = array(".mesh_reference");
  point.rates.fluid_reference = array(".flow_reference");
  point.support_loads = array(".support_loads");
  point.opening_pressures = array(".opening_pressures");
  point.rates.openings_reference = array(".windkessels");
  point.now.openings = array(".opening_values");
  point.rates.step = number(".step");
  point.rates.interface.period = number(".period");
  point.rates.fluid_factor = number(".flow_factor");
  point.rates.acceleration_factor = number(".acceleration_factor");
  point.wall_pressure = number(".wall_pressure");
  return true;
}

template <int n>
NewtonStepper<n>::NewtonStepper(Scene<n>& scene, const Loads& loads, NewtonOptions options, Numbering numbering,
                                const LinearSolverFactory<n>& make_solver)
    : scene_(scene),
      loads_(loads),
      options_(std::move(options)),
      system_("coupled", scene, std::move(numbering), make_solver) {}

template <int n>
StepReport NewtonStepper<n>::advance(State& state) {
  report_ = {};
  const int stages = scene_.integrator->stages(state);
  for (int stage = 0; stage < stages; ++stage) {
    StepData data = loads_.next(state, *scene_.integrator, stage);
    advance_stage(state, data);
    scene_.settle_openings(state.now, data.rates);
    if (rejects(state, data)) break;
    if (keep_balances_) report_.balances.push_back({state.now, data});
    if (data.rates.last_stage)
      accept_level(scene_, data, state);
    else
      scene_.integrator->accept(state, data);
  }
  return report_;
}

template <int n>
void NewtonStepper<n>::advance_stage(State& state, const StepData& data) {
  NewtonReport solved = solve(state, data, scene_.predictor);
  if (!solved.converged && scene_.predictor > 0 && state.step > 0) {
    // The extrapolated start can be the culprit, after a jump of the load for example.
    report_.history.push_back(solved.failure + "; again from the last time level");
    solved = solve(state, data, 0);
  }
  if (!solved.converged)
    throw ConvergenceError(fmt::format("{}: Newton's method stopped after {} iterations: {}", name_of_step(state, data),
                                       solved.count(), solved.failure),
                           remedy(solved));
}

template <int n>
Memory NewtonStepper<n>::memory() const {
  Memory memory;
  if (options_.mode != NewtonMode::full && system_.linearised())
    remember("kept", system_.linearisation_point(), memory);
  return memory;
}

template <int n>
void NewtonStepper<n>::recall(const Memory& memory) {
  LinearisationPoint point;
  if (fsi::recall("kept", memory, point)) system_.linearise_at(point);
}

template <int n>
std::string NewtonStepper<n>::name_of_step(const State& state, const StepData& data) const {
  return scene_.is_static() ? fmt::format("load step {} (to {:g} of the load)", state.step + 1, data.time)
                            : fmt::format("step {} (to t = {:g} ms)", state.step + 1, data.time);
}

template <int n>
std::string NewtonStepper<n>::remedy(const NewtonReport& failed) const {
  std::string text = scene_.is_static() ? "more static.load_steps or a smaller load" : "a smaller time.step or load";
  if (options_.mode != NewtonMode::full) text += ", or monolithic.mode = \"full\"";
  if (failed.count() >= options_.max_iterations) text += ", or a larger monolithic.max_iterations";
  return text;
}

template <int n>
NewtonReport NewtonStepper<n>::solve(State& state, const StepData& data, int predictor) {
  scene_.integrator->predict(state, predictor, data);
  scene_.impose_conditions(state.now);
  scene_.impose_inflows(state, data);
  scene_.impose_interface(state, data.rates);
  system_.work_on(state, data);
  NewtonReport solved = newton(system_, options_);
  scene_.impose_interface(state, data.rates);  // exactly, not to the rounding of the increments
  report_.newton_iterations += solved.count();
  report_.linear_iterations += solved.linear_iterations();
  report_.history.push_back(fmt::format("first residual {:.3e}", solved.first_residual));
  append_history(solved, report_.history);
  if (solved.converged) report_.solver_error = std::max(report_.solver_error, solved.error);
  return solved;
}

#define FSI_INSTANTIATE(n) template class NewtonStepper<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
