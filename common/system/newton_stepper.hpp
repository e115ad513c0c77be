#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

#include "base/error.hpp"
#include "case/case.hpp"
#include "system/system.hpp"
#include "time/loads.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// Newton's options as the case states them.
inline NewtonOptions newton_options(const MonolithicData& data) {
  NewtonOptions options;
  options.tolerance = data.newton_tolerance;
  options.residual_tolerance = data.residual_tolerance;
  options.max_iterations = data.max_iterations;
  options.linear_tolerance = data.linear_tolerance;
  options.keep_jacobian = data.mode == "kept";
  return options;
}

/// Lines of the paper's Table 3: iteration, increment, residual.
inline void append_history(const NewtonReport& report, std::vector<std::string>& lines,
                           const std::string& indent = "") {
  int k = 0;
  for (const auto& it : report.iterations)
    lines.push_back(
        fmt::format("{}newton {:2d}  increment {:.3e}  residual {:.3e}{}{}{}", indent, ++k, it.increment, it.residual,
                    it.linear_iterations > 0 ? fmt::format("  linear {}", it.linear_iterations) : "",
                    it.step < 1 ? fmt::format("  step {:g}", it.step) : "", it.linearised ? "  new jacobian" : ""));
}

/// A linearisation point as numbers to remember, and back.
inline void remember(const std::string& name, const LinearisationPoint& point, Memory& memory) {
  memory.arrays[name + ".mesh"] = point.now.mesh;
  memory.arrays[name + ".flow"] = point.now.flow;
  memory.arrays[name + ".wall"] = point.now.wall;
  memory.arrays[name + ".old_mesh"] = point.old.mesh;
  memory.arrays[name + ".old_flow"] = point.old.flow;
  memory.numbers[name + ".wall_pressure"] = point.wall_pressure;
}
inline bool recall(const std::string& name, const Memory& memory, LinearisationPoint& point) {
  const auto pressure = memory.numbers.find(name + ".wall_pressure");
  if (pressure == memory.numbers.end()) return false;
  const auto array = [&](const char* part) {
    const auto found = memory.arrays.find(name + part);
    return found == memory.arrays.end() ? std::vector<double>() : found->second;
  };
  point.now = {array(".mesh"), array(".flow"), array(".wall")};
  point.old = {array(".old_mesh"), array(".old_flow"), {}};
  point.wall_pressure = pressure->second;
  return true;
}

/// Advances a whole scene at once by Newton's method: the monolithic method for fluid and wall, and the only one there
/// is for a scene with one of them.
template <class Element>
class NewtonStepper : public Stepper {
 public:
  NewtonStepper(Scene<Element>& scene, const Loads& loads, NewtonOptions options,
                const LinearSolverFactory<Element>& make_solver = {})
      : scene_(scene),
        loads_(loads),
        options_(std::move(options)),
        system_("coupled", scene, number_scene(scene), make_solver) {}

  const System<Element>& system() const { return system_; }

  StepReport advance(State& state) override {
    const StepData data = loads_.next(state, scene_.scheme);
    report_ = {};
    NewtonReport solved = solve(state, data, scene_.scheme);
    if (!solved.converged && scene_.scheme.predictor > 0 && state.step > 0) {
      // The extrapolated start can be the culprit, after a jump of the load for example.
      report_.history.push_back(solved.failure + "; again from the last time level");
      TimeScheme cautious = scene_.scheme;
      cautious.predictor = 0;
      solved = solve(state, data, cautious);
    }
    if (!solved.converged)
      throw ConvergenceError(fmt::format("{}: Newton's method stopped after {} iterations: {}",
                                         name_of_step(state, data), solved.count(), solved.failure),
                             remedy(solved));
    scene_.scheme.accept(state, data);
    return report_;
  }

  Memory memory() const override {
    Memory memory;
    if (options_.keep_jacobian && system_.linearised()) remember("kept", system_.linearisation_point(), memory);
    return memory;
  }

  void recall(const Memory& memory) override {
    LinearisationPoint point;
    if (fsi::recall("kept", memory, point)) system_.linearise_at(point);
  }

 private:
  std::string name_of_step(const State& state, const StepData& data) const {
    return scene_.scheme.is_static() ? fmt::format("load step {} (to {:g} of the load)", state.step + 1, data.time)
                                     : fmt::format("step {} (to t = {:g} ms)", state.step + 1, data.time);
  }

  std::string remedy(const NewtonReport& failed) const {
    std::string text =
        scene_.scheme.is_static() ? "more static.load_steps or a smaller load" : "a smaller time.step or load";
    if (options_.keep_jacobian) text += ", or monolithic.mode = \"full\"";
    if (failed.count() >= options_.max_iterations) text += ", or a larger monolithic.max_iterations";
    return text;
  }

  NewtonReport solve(State& state, const StepData& data, const TimeScheme& scheme) {
    scheme.predict(state);
    scene_.impose_interface(state);
    system_.work_on(state, data);
    const NewtonReport solved = newton(system_, options_);
    scene_.impose_interface(state);  // exactly, not to the rounding of the increments
    report_.newton_iterations += solved.count();
    report_.linear_iterations += solved.linear_iterations();
    report_.history.push_back(fmt::format("first residual {:.3e}", solved.first_residual));
    append_history(solved, report_.history);
    return solved;
  }

  Scene<Element>& scene_;
  const Loads& loads_;
  NewtonOptions options_;
  System<Element> system_;
};

}  // namespace fsi
