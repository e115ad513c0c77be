#include "system/newton_stepper.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "system/level_check.hpp"
#include "system/step_continuation.hpp"
#include "system/wall_check.hpp"
#include "time/predictor.hpp"

namespace fsi {

void append_history(const NewtonReport& report, std::vector<std::string>& lines, const std::string& indent) {
  int k = 0;
  for (const auto& it : report.iterations)
    lines.push_back(fmt::format("{}newton {:2d}  increment {:.3e}  residual {}{}{}{}", indent, ++k, it.increment,
                                std::isnan(it.residual) ? "not evaluated" : fmt::format("{:.3e}", it.residual),
                                it.linear_iterations > 0 ? fmt::format("  linear {}", it.linear_iterations) : "",
                                it.step < 1 ? fmt::format("  step {:g}", it.step) : "",
                                it.linearised ? "  new jacobian" : ""));
}

namespace {

constexpr std::size_t most_openings = 100000;
constexpr double way_tolerance = 1e-4;  // of solutions of shorter steps, which are only starts

/// All of it, or nothing. \returns whether there is such a point
bool keep(const std::string& name, LinearisationPoint& point, RestartArchive& archive) {
  Solution& now = point.now;
  StepRates& rates = point.rates;
  const std::pair<const char*, double*> numbers[] = {{".step", &rates.step},
                                                     {".period", &rates.interface.period},
                                                     {".flow_factor", &rates.fluid_factor},
                                                     {".acceleration_factor", &rates.acceleration_factor},
                                                     {".wall_pressure", &point.wall_pressure}};
  if (!archive.wants({name + ".step", name + ".mesh", name + ".flow", name + ".wall", name + ".mesh_reference",
                      name + ".flow_reference"}))
    return false;
  for (const auto& [part, number] : numbers) archive.number(name + part, *number);
  archive.array(name + ".mesh", ArrayKind::mesh, now.mesh);
  archive.array(name + ".flow", ArrayKind::flow, now.fluid);
  archive.array(name + ".wall", ArrayKind::wall, now.wall);
  archive.array(name + ".mesh_reference", ArrayKind::mesh, rates.mesh_reference);
  archive.array(name + ".flow_reference", ArrayKind::flow, rates.fluid_reference);
  const auto if_any = [&](const char* part, ArrayKind kind, std::vector<double>& values, const ArrayRule& rule = {}) {
    if (archive.recalls() ? archive.has(name + part) : !values.empty()) archive.array(name + part, kind, values, rule);
  };
  // `there` is the same at all processes, also at those without nodes of the wall.
  const auto if_there = [&](bool there, const char* part, ArrayKind kind, std::vector<double>& values) {
    if (archive.recalls() ? archive.has(name + part) : there) archive.array(name + part, kind, values);
  };
  if_there(point.viscous_wall, ".wall_reference", ArrayKind::wall, rates.wall_reference);
  // Checkpoints of earlier versions have no such lag.
  if (archive.recalls() ? archive.has(name + ".strain_lag") : point.viscous_wall)
    archive.number(name + ".strain_lag", rates.strain_lag);
  if_there(point.branches, ".branches_reference", ArrayKind::wall_branches, rates.branches_reference);
  if_any(".support_loads", ArrayKind::support_loads, point.support_loads);
  if_any(".opening_pressures", ArrayKind::alike, point.opening_pressures, {{}, {}, most_openings});
  if (point.opening_pressures.empty()) return true;
  if_any(".windkessels", ArrayKind::opening_values, rates.openings_reference);
  if_any(".opening_values", ArrayKind::opening_values, now.openings);
  if (archive.recalls() ? archive.has(name + ".time") : !rates.openings_reference.empty())
    archive.number(name + ".time", rates.time);  // on which what a network joins depends
  return true;
}

}  // namespace

template <int n>
void keep_linearisation(const std::string& name, System<n>& system, RestartArchive& archive,
                        const std::function<void(const StepRates&)>& prepare) {
  LinearisationPoint point;
  if (!archive.recalls()) {
    if (!system.linearised()) return;
    point = system.linearisation_point();
    keep(name, point, archive);
  } else if (keep(name, point, archive) && !archive.step_changed()) {
    if (prepare) prepare(point.rates);
    system.linearise_at(point);
  }
}

template <int n>
NewtonStepperBase<n>::NewtonStepperBase(Scene<n>& scene, const Loads& loads, NewtonOptions options)
    : scene_(scene), loads_(loads), options_(std::move(options)) {}

template <int n>
std::vector<StepperChoice> NewtonStepperBase<n>::stopping() const {
  if (options_.error_tolerance == 0) return {};
  return {{"newton.error_tolerance", fmt::format("{:g}", options_.error_tolerance),
           "a step is solved when its error is estimated to be that part of what the step changes"}};
}

template <int n>
StepReport NewtonStepperBase<n>::advance(State& state) {
  try {
    return advance_all_stages(state);
  } catch (const ConvergenceError&) {
    abandon();
    throw;
  }
}

template <int n>
StepReport NewtonStepperBase<n>::advance_all_stages(State& state) {
  report_ = {};
  const int stages = scene_.integrator->stages(state);
  for (int stage = 0; stage < stages; ++stage) {
    StepData data = loads_.next(state, *scene_.integrator, stage);
    advance_stage(state, data);
    scene_.settle_openings(state.now, data.rates);
    scene_.settle_branches(state.now, data.rates);
    if (rejects(state, data)) {
      abandon();
      break;
    }
    if (keep_balances_) report_.balances.push_back({state.now, data});
    if (data.rates.last_stage)
      accept_level(scene_, data, state, spare_, report_);
    else
      scene_.integrator->accept(state, data);
  }
  return report_;
}

template <int n>
void NewtonStepperBase<n>::advance_stage(State& state, StepData& data) {
  NewtonReport solved = solve(state, data, scene_.predictor);
  if (!solved.converged && scene_.predictor > 0 && state.step > 0) {
    // The extrapolated start may be the reason, as after a jump of the load.
    abandon();
    report_.history.push_back(solved.failure + "; again from the last time level");
    solved = solve(state, data, 0);
    report_.strayed = true;
  }
  if (!solved.converged && this->persists_ && !scene_.is_static()) {
    abandon();
    report_.history.push_back(solved.failure + "; again from solutions of shorter steps");
    const NewtonReport slowly = solve_slowly(state, data);
    if (slowly.converged)
      solved = slowly;
    else
      solved.failure += slowly.failure;
  }
  if (solved.converged) {
    report_.strayed = report_.strayed || solved.strayed;
    report_.solver_error = std::max(report_.solver_error, solved.error);
    return finish_stage(state, data);
  }
  const std::string valve = scene_.openings.joined().complaint();
  throw ConvergenceError(fmt::format("{}: Newton's method stopped after {} iterations: {}",
                                     name_of_step(scene_, state.step + 1, data), solved.count(), solved.failure) +
                             (valve.empty() ? "" : "; " + valve),
                         valve.empty() ? remedy(solved) : remedy(solved) + ", or " + JoinedOpenings<n>::remedy);
}

template <int n>
std::string NewtonStepperBase<n>::remedy(const NewtonReport& failed) const {
  std::string text = scene_.is_static() ? "more static.load_steps or a smaller load" : "a smaller time.step or load";
  if (options_.mode != NewtonMode::full) text += ", or newton.mode = \"full\"";
  if (failed.count() >= options_.max_iterations) text += ", or a larger newton.max_iterations";
  return text;
}

template <int n>
NewtonReport NewtonStepperBase<n>::solve(State& state, StepData& data, int predictor) {
  scene_.integrator->predict(state, predictor, data);
  return solve_from_there(state, data, options_);
}

template <int n>
NewtonReport NewtonStepperBase<n>::solve_slowly(State& state, StepData& data) {
  scene_.integrator->predict(state, 0, data);
  NewtonReport solved;
  const StepWalk walk = walk_to_step(state.now, [&](double share) {
    if (share == 1) {
      solved = solve_from_there(state, data, options_);
    } else {
      StepData part = data;
      part.rates = scene_.integrator->rates(state, share * data.rates.step, data.rates.stage);
      NewtonOptions options = options_;
      options.tolerance = std::max(options.tolerance, way_tolerance);
      solved = solve_from_there(state, part, options);
    }
    report_.history.push_back(fmt::format("a step of {:g} ms, {:.4g} of the length: {}", share * data.rates.step, share,
                                          solved.converged ? "solved" : solved.failure));
    if (!solved.converged) abandon();
    return solved.converged;
  });
  if (walk.arrived()) return solved;
  solved.failure.clear();
  if (walk.solved > 0)
    solved.failure =
        fmt::format("; with this load and start a step of {:.4g} ms has a solution, none of {:.4g} ms was found",
                    walk.solved * data.rates.step, walk.failed * data.rates.step);
  return solved;
}

template <int n>
NewtonReport NewtonStepperBase<n>::solve_from_there(State& state, StepData& data, const NewtonOptions& options) {
  scene_.impose_conditions(state.now);
  scene_.impose_inflows(state, data);
  scene_.impose_interface(state, data.rates);
  NewtonReport solved;
  try {
    solved = newton(equations(state, data), options);
  } catch (const ConvergenceError& failure) {  // of the linear solver, whose matrix can be beyond all numbers
    solved.failure = failure.what();
  }
  scene_.impose_interface(state, data.rates);    // exactly, not to the rounding of the increments
  if (solved.converged && scene_.is_static()) {  // another start may lead to another solution
    if (const WallCheck check = check_wall(scene_, state.now.wall); !check.fault.empty()) {
      solved.converged = false;
      solved.failure = "what it came to is no solution: " + check.fault;
    }
  }
  report_.newton_iterations += solved.count();
  report_.linear_iterations += solved.linear_iterations();
  report_.history.push_back(fmt::format("first residual {:.3e}", solved.first_residual));
  append_history(solved, report_.history);
  return solved;
}

namespace {

/// Only a network reads the residual after a monolithic step: it settles by the last evaluation.
template <int n>
NewtonOptions without_last_residual(const Scene<n>& scene, NewtonOptions options) {
  options.last_residual = scene.is_static() || !scene.openings.joined().empty();
  return options;
}

}  // namespace

template <int n>
NewtonStepper<n>::NewtonStepper(Scene<n>& scene, const Loads& loads, NewtonOptions options, Numbering numbering,
                                const LinearSolverFactory<n>& make_solver)
    : NewtonStepperBase<n>(scene, loads, without_last_residual(scene, std::move(options))),
      system_("coupled", scene, std::move(numbering), make_solver) {}

template <int n>
std::optional<CouplingMethod> NewtonStepper<n>::coupling_method() const {
  if (!this->scene_.coupled()) return std::nullopt;
  return CouplingMethod{"monolithic",
                        "one Newton iteration for fluid, wall and mesh, whose linear systems hold all of them"};
}

template <int n>
std::vector<StepperChoice> NewtonStepper<n>::choices() const {
  std::vector<StepperChoice> all = this->stopping();
  if (const std::string decides = system_.solver().decides(); !decides.empty())
    all.push_back({"linear.direct_below", "by the wall", decides});
  return all;
}

template <int n>
NewtonProblem& NewtonStepper<n>::equations(State& state, StepData& data) {
  system_.work_on(state, data);
  return system_;
}

template <int n>
void NewtonStepper<n>::keep(RestartArchive& archive) {
  if (this->options().mode != NewtonMode::full || archive.recalls()) keep_linearisation("kept", system_, archive);
}

#define FSI_INSTANTIATE(n)                                                             \
  template void keep_linearisation<n>(const std::string&, System<n>&, RestartArchive&, \
                                      const std::function<void(const StepRates&)>&);   \
  template class NewtonStepperBase<n>;                                                 \
  template class NewtonStepper<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
