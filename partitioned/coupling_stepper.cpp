#include "partitioned/coupling_stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra/vector_operations.hpp"
#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "partitioned/interface/coupling_pass.hpp"
#include "partitioned/scheme_choice.hpp"
#include "system/level_check.hpp"
#include "system/step_change.hpp"

namespace fsi {

template <int n>
CouplingStepper<n>::CouplingStepper(Scene<n>& scene, const Loads& loads, const Case& setup,
                                    const CouplingScheme& scheme, std::unique_ptr<CouplingPass<n>> problem)
    : scene_(scene),
      loads_(loads),
      options_(setup.partitioned),
      agreement_(options_),
      predictor_(setup.time ? setup.time->predictor : std::nullopt),
      choices_{{"partitioned.scheme", std::string(scheme.name), chosen_scheme(setup, scene).reason}},
      scheme_(scheme),
      space_(scene.processes(), scene.owned_interface() * n),
      fluid_volumes_(owned_volumes<n>(scene.fluid->space(), scene.fluid->nodes())),
      wall_volumes_(owned_volumes<n>(scene.wall->space(), scene.wall->nodes())),
      accelerator_(scheme_.make_accelerator(options_, space_)),
      problem_(std::move(problem)) {}

template <int n>
std::optional<CouplingMethod> CouplingStepper<n>::coupling_method() const {
  return CouplingMethod{"interface",
                        "a pass solves the fluid and then the wall, each by itself to a hundredth of the interface's "
                        "residual; traces alone cross the interface"};
}

template <int n>
StepReport CouplingStepper<n>::advance(State& state) {
  solve_step(state);
  if (!report_.rejected) finish_step(state);
  return report_;
}

template <int n>
void CouplingStepper<n>::solve_step(State& state) {
  report_ = {};
  report_.outer_iterations = 0;
  coupling_ = {};
  problem_->cost = {};
  const auto abandon = [this, started_far = starts_far_] {
    accelerator_->abandon();
    starts_far_ = started_far;
    take_back();
  };
  const int stages = scene_.integrator->stages(state);
  try {
    begin_step(state);
    for (int stage = 0; stage < stages; ++stage) {
      StepData data = loads_.next(state, *scene_.integrator, stage);
      ends_at_jump_ = data.ends_at_jump;
      advance_stage(state, data);
      scene_.settle_openings(state.now, data.rates);
      scene_.settle_branches(state.now, data.rates);
      if (rejects(state, data)) {
        abandon();
        return;
      }
      if (keep_balances_) report_.balances.push_back({state.now, data});
      if (data.rates.last_stage)
        accept_level(scene_, data, state, spare_, report_);
      else
        scene_.integrator->accept(state, data);
    }
  } catch (const ConvergenceError&) {  // the run may try again with a shorter step
    abandon();
    throw;
  }
}

template <int n>
void CouplingStepper<n>::finish_step(const State&) {
  problem_->finish_step();
  after_jump_ = ends_at_jump_;
}

template <int n>
void CouplingStepper<n>::advance_stage(State& state, StepData& data) {
  std::vector<double> x = start_stage(state, data);
  GoodPass good;
  PassAccuracy accuracy = first_accuracy();
  bool first = true;
  int failures = 0;  // since the stage began anew
  const auto begin_anew = [&](const char* why) {
    const std::string way = another_way();
    if (way.empty()) return false;
    report_.history.push_back(fmt::format("{}: the stage begins anew with {}", why, way));
    failures = 0;
    accelerator_->abandon();
    problem_->start_from_prediction(state, data, order_);
    accelerator_->start();
    monitor_.start();
    x = problem_->first_guess(order_);
    good = {};
    accuracy = first_accuracy();
    return true;
  };
  for (passes_ = 1; passes_ <= options_.max_iterations; ++passes_) {
    ++report_.outer_iterations;
    Pass pass;
    try {
      pass = measured_pass(x, accuracy);
    } catch (const PassFailure& failure) {
      if (++failures < most_failures || !begin_anew(failure.what())) retreat(failure, state, data, x, good);
      continue;
    }
    log_pass();
    if (std::exchange(first, false)) starts_far_ = coupling_.displacement_residual > far;
    judge_pass(state, data);
    if (!iterates() || agrees(state, data, good)) {
      coupling_.domain_gap = problem_->domain_gap();
      report_.solver_error = std::max(report_.solver_error, estimated_error(state, data, good));
      accept(state, data, x, pass);
      return;
    }
    if (leads_nowhere() && begin_anew("the passes lead nowhere")) continue;
    if (monitor_.diverges(coupling_.displacement_gap)) give_up(state, data, "diverges");
    good = {true, x, state.now, coupling_.displacement_gap};
    correct(pass, x, accuracy);
  }
  --passes_;
  give_up(state, data, "did not converge");
}

template <int n>
std::vector<double> CouplingStepper<n>::start_stage(State& state, StepData& data) {
  order_ = first_order();
  begin_stage(state, data);
  problem_->start_from_prediction(state, data, order_);
  note_period(data.rates.interface.period);
  accelerator_->start();
  monitor_.start();
  return problem_->first_guess(order_);
}

template <int n>
Pass CouplingStepper<n>::measured_pass(const std::vector<double>& x, const PassAccuracy& accuracy) {
  Pass pass = problem_->pass(x, accuracy);
  measure(pass);
  if (!iterates() || !refines() || !agreement_.met_by(coupling_)) return pass;
  if (!accuracy.linearised_wall && !agreement_.needs_tighter(accuracy.tolerance, coupling_)) return pass;
  pass = problem_->refine({agreement_.final_tolerance(coupling_), false});
  measure(pass);
  return pass;
}

template <int n>
void CouplingStepper<n>::correct(const Pass& pass, std::vector<double>& x, PassAccuracy& accuracy) {
  {
    const Stopwatch watch(coupling_.algebra_seconds);
    accelerator_->aim(agreement_.demand(coupling_) * space_.norm(pass.displacement) / std::abs(pass.gap_part));
    accelerator_->correct(x, pass.residual);
  }
  next_accuracy(accuracy);
}

template <int n>
PassAccuracy CouplingStepper<n>::first_accuracy() {
  if (!iterates()) return {agreement_.final_tolerance(coupling_), false};
  return {agreement_.first_tolerance(coupling_), starts_far_};
}

template <int n>
void CouplingStepper<n>::next_accuracy(PassAccuracy& accuracy) {
  accuracy.tolerance = agreement_.next_tolerance(coupling_);
  if (accelerator_->allows_change()) accuracy.linearised_wall = coupling_.displacement_residual > far;
}

template <int n>
bool CouplingStepper<n>::agrees(const State&, const StepData&, const GoodPass&) {
  return agreement_.met_by(coupling_);
}

template <int n>
std::string CouplingStepper<n>::another_way() {
  return problem_->change_coefficient() ? "another Robin coefficient" : "";
}

template <int n>
void CouplingStepper<n>::go_on_by(std::unique_ptr<CouplingPass<n>> problem, std::unique_ptr<Accelerator> accelerator) {
  problem->cost = problem_->cost;
  problem_ = std::move(problem);
  accelerator_ = std::move(accelerator);
}

template <int n>
MatrixValues CouplingStepper<n>::matrix_values() const {
  return {problem_->fluid().fluid_values(), problem_->wall().wall_values()};
}

template <int n>
double CouplingStepper<n>::change_since(const State& state, const StepData& data, const GoodPass& good) const {
  std::vector<double> fluid = state.now.fluid, wall = state.now.wall;
  axpy(-1, good.fields.fluid, fluid);
  axpy(-1, good.fields.wall, wall);
  return relative_to_step<n>(state, data, {fluid_volumes_, fluid}, {wall_volumes_, wall}, scene_.processes());
}

template <int n>
void CouplingStepper<n>::keep(RestartArchive& archive) {
  problem_->keep(archive);
  accelerator_->keep(archive);
  double starts_far = starts_far_ ? 1 : 0;
  archive.number_if_there("starts_far", starts_far);
  starts_far_ = starts_far != 0;
  archive.number_if_there("interface_period", period_);
}

template <int n>
void CouplingStepper<n>::keep_jump(RestartArchive& archive) {
  double jumped = after_jump_ ? 1 : 0;
  archive.number_if_there("after_jump", jumped);
  after_jump_ = jumped != 0;
}

template <int n>
void CouplingStepper<n>::note_period(double period) {
  if (period_ > 0 && period <= likeness * period_ && period_ <= likeness * period) return;
  if (period_ > 0) accelerator_->change(period > period_);
  period_ = period;
  if (!agreement_.weighs_pressure() || !refines()) return;
  report_.history.push_back(
      fmt::format("interface: velocities over {:g} ms, where a gap between fluid and wall is worth {:.4g} kPa/mm; "
                  "tolerance {:g} of "
                  "the pressure and of the displacement",
                  period, problem_->pressure_per_gap(), options_.gap_tolerance()));
}

template <int n>
double CouplingStepper<n>::size_of(const Pass& pass) const {
  return space_.norm(pass.displacement);
}

template <int n>
void CouplingStepper<n>::measure(const Pass& pass) {
  const std::vector<double> gap = pass.gap();
  coupling_.displacement_gap = space_.norm(gap);
  double size = size_of(pass);
  if (scene_.initial_load)  // displacements count from a loaded shape, and may all be next to zero
    if (const auto numbers = space_.size(pass.displacement); numbers > 0)
      size = std::max(size, smallest_motion * problem_->pressure_of_thickness() / problem_->pressure_per_gap() *
                                std::sqrt(static_cast<double>(numbers)));
  coupling_.displacement_residual = size > 0
                                        ? coupling_.displacement_gap / size
                                        : (coupling_.displacement_gap > 0 ? std::numeric_limits<double>::max() : 0.0);
  // The force residual costs an assembly of the fluid. Where nothing is demanded of it and passes are cheap, it is
  // measured in accept() alone.
  if (refines() || options_.force_tolerance > 0) coupling_.force_residual = problem_->force_residual();
  coupling_.pressure_residual = problem_->pressure_residual(gap);
  coupling_.gap_pressure = problem_->gap_pressure(gap);
  coupling_.traction_gap = problem_->traction_gap();
}

template <int n>
void CouplingStepper<n>::log_pass() {
  const AcceleratorStatus status = accelerator_->status();
  const CouplingCost& cost = problem_->cost;
  report_.history.push_back(
      fmt::format("coupling {:3d}  |d~ - d| / |d~| = {:.3e}  pressure {:.3e}  force {:.3e}  {}  newton {} + {}",
                  passes_, coupling_.displacement_residual, coupling_.pressure_residual, coupling_.force_residual,
                  status.columns > 0 ? fmt::format("columns {}", status.columns)
                                     : fmt::format("relaxation {:.5f}", status.relaxation),
                  cost.fluid_newton, cost.wall_newton));
}

template <int n>
void CouplingStepper<n>::give_up(const State& state, const StepData& data, const char* what) const {
  const std::string valve = scene_.openings.joined().complaint();
  throw ConvergenceError(
      fmt::format("step {} (to t = {:g} ms): the {} coupling {} in {} iterations, {}", state.step + 1, data.time,
                  scheme_.name, what, passes_, distance_from_demand()) +
          (valve.empty() ? "" : "; " + valve),
      valve.empty() ? scheme_.advice : std::string(scheme_.advice) + ", or " + JoinedOpenings<n>::remedy);
}

template <int n>
std::string CouplingStepper<n>::distance_from_demand() const {
  return fmt::format("|d~ - d| / |d~| = {:.2e}, wanted {:g}; pressure {:.2e}{}; force {:.2e}{}",
                     coupling_.displacement_residual, options_.gap_tolerance(), coupling_.pressure_residual,
                     agreement_.weighs_pressure() ? fmt::format(", wanted {:g}", options_.gap_tolerance()) : "",
                     coupling_.force_residual,
                     options_.force_tolerance > 0 ? fmt::format(", wanted {:g}", options_.force_tolerance) : "");
}

template <int n>
void CouplingStepper<n>::retreat(const PassFailure& failure, State& state, StepData& data, std::vector<double>& x,
                                 const GoodPass& good) {
  const bool extrapolated = !good.found && order_ > 0 && state.step > 0;
  ++coupling_.failed_passes;
  report_.history.push_back(fmt::format("coupling {:3d}  no answer from {}", passes_, failure.what()));
  const bool more = iterates() && coupling_.failed_passes <= most_retreats;
  const bool stiffened = more && !good.found && !extrapolated && problem_->stiffen();
  if (!more || (!good.found && !extrapolated && !stiffened)) {
    for (const auto& line : failure.history()) report_.history.push_back(line);
    const std::string valve = scene_.openings.joined().complaint();
    throw ConvergenceError(
        fmt::format("step {} (to t = {:g} ms): the {} coupling found no answer in pass {}: {}", state.step + 1,
                    data.time, scheme_.name, passes_, failure.what()) +
            (valve.empty() ? "" : "; " + valve),
        advice_without_answer() + (valve.empty() ? std::string() : std::string(", or ") + JoinedOpenings<n>::remedy));
  }
  if (extrapolated || stiffened) {
    order_ = 0;  // the extrapolation may be to blame, for example after a jump of the load
    problem_->start_from_prediction(state, data, order_);
    x = problem_->first_guess(order_);
    return;
  }
  state.now = good.fields;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = good.x[i] + retreat_factor * (x[i] - good.x[i]);
}

template <int n>
double CouplingStepper<n>::estimated_error(const State& state, const StepData& data, const GoodPass& good) const {
  const double left = good.found ? coupling_.displacement_gap / good.gap : 1;
  if (left < 1) {
    // A quasi-Newton method knows more with each pass: the next gains at least as much as one that halves.
    const double slowest = accelerator_->status().columns > 0 ? 0.5 : 1;
    const double ratio = std::min(left, slowest);
    return change_since(state, data, good) * ratio / (1 - ratio);
  }
  std::vector<double> fluid = state.now.fluid, wall = state.now.wall;
  // As large as itself at most: the interface may bear no load, or not move, and has no relative residual then.
  const double displacement = std::min(coupling_.displacement_residual, 1.0);
  const double pressure = std::min(coupling_.pressure_residual, 1.0);
  for (std::size_t i = 0; i < fluid.size(); ++i) fluid[i] *= static_cast<int>(i % (n + 1)) == n ? pressure : 0;
  for (std::size_t i = 0; i < wall.size(); ++i) wall[i] *= static_cast<int>(i % (n + 1)) == n ? pressure : displacement;
  return relative_to_step<n>(state, data, {fluid_volumes_, fluid}, {wall_volumes_, wall}, scene_.processes());
}

template <int n>
void CouplingStepper<n>::accept(State& state, const StepData& data, const std::vector<double>& x, const Pass& pass) {
  if (iterates()) {
    const Stopwatch watch(coupling_.algebra_seconds);
    accelerator_->accept(x, pass.residual);
  }
  if (!refines()) coupling_.force_residual = problem_->force_residual();
  problem_->accept();
  finish_stage(state, data);
  const CouplingCost& cost = problem_->cost;
  report_.newton_iterations = cost.fluid_newton + cost.wall_newton;
  report_.linear_iterations = cost.fluid_linear + cost.wall_linear;
  const AcceleratorStatus status = accelerator_->status();
  coupling_.relaxation = status.relaxation;
  coupling_.columns = status.columns;
  coupling_.fluid_newton_iterations = cost.fluid_newton;
  coupling_.wall_newton_iterations = cost.wall_newton;
  coupling_.fluid_linear_iterations = cost.fluid_linear;
  coupling_.wall_linear_iterations = cost.wall_linear;
  coupling_.fluid_seconds = cost.fluid_seconds;
  coupling_.wall_seconds = cost.wall_seconds;
  coupling_.mesh_seconds = cost.mesh_seconds;
  report_.coupling = coupling_;
}

template <int n>
CouplingStepper<n>::~CouplingStepper() = default;

#define FSI_INSTANTIATE(n) template class CouplingStepper<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
