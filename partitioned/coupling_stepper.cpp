#include "partitioned/coupling_stepper.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra/vector_operations.hpp"
#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "partitioned/interface/dirichlet_neumann.hpp"
#include "partitioned/interface/robin_neumann.hpp"
#include "partitioned/interface/wetted_sides.hpp"
#include "scene/time_scheme.hpp"
#include "system/level_check.hpp"
#include "system/step_change.hpp"

namespace fsi {

template <int n>
CouplingStepper<n>::CouplingStepper(Scene<n>& scene, const Loads& loads, const Case& setup)
    : scene_(scene),
      loads_(loads),
      options_(setup.partitioned),
      predictor_(setup.time ? setup.time->predictor : std::nullopt),
      choice_(chosen_scheme(setup, scene)),
      scheme_(coupling_scheme(choice_.name)),
      space_(scene.processes(), scene.owned_interface() * n),
      fluid_volumes_(owned_volumes<n>(scene.fluid->space(), scene.fluid->nodes())),
      wall_volumes_(owned_volumes<n>(scene.wall->space(), scene.wall->nodes())),
      accelerator_(scheme_.make_accelerator(options_, space_)),
      velocity_gap_(options_.velocity_gap) {
  if (scheme_.one_pass && first_order() == 0)
    throw InputError(
        setup.path.string(), "time.predictor",
        fmt::format("0 with partitioned.scheme = \"{}\": the fluid would see a wall that never moves", scheme_.name),
        "use 1 or 2");
  if (const auto time_scheme = setup.time ? time_scheme_of(setup, scene) : TimeScheme::euler;
      scheme_.one_pass && (time_scheme == TimeScheme::midpoint || time_scheme == TimeScheme::tr_bdf2))
    throw InputError(setup.path.string(), "time.scheme",
                     fmt::format("\"{}\" with partitioned.scheme = \"{}\": what one pass leaves between fluid and wall "
                                 "comes back with every step, and the pressure is wrong",
                                 time_schemes().name_of(time_scheme), scheme_.name),
                     "use \"euler\", \"generalised-alpha\" or \"bdf2\", or a coupling scheme that iterates");
  if (!scheme_.robin && scene.coupled() && scene.has_flow_only())
    throw InputError(setup.path.string(), "partitioned.scheme",
                     fmt::format("\"{}\" gives the fluid its velocity on the wall, and the case does so at every "
                                 "opening: its pressure is not determined",
                                 scheme_.name),
                     "use a scheme that begins with robin-neumann, or give one opening a pressure, a resistance or a "
                     "windkessel");
  if (scheme_.robin && wetted_sides_of(scene).stands_in_the_fluid())
    scene.notices.push_back(fmt::format(
        "{}: partitioned.scheme: \"{}\" takes the wall for a tube around the fluid, and this one stands in the fluid, "
        "so that steps may find no solution; {}",
        setup.path.string(), scheme_.name,
        scene.has_flow_only() ? "give one opening a pressure, a resistance or a windkessel, and name \"iqn-ils\""
                              : "name \"iqn-ils\""));
  else if (scheme_.robin)
    note_long_steps(setup);
  if (scheme_.robin)
    problem_ = std::make_unique<RobinNeumann<n>>(scene, options_);
  else
    problem_ = std::make_unique<DirichletNeumann<n>>(scene, options_);
}

template <int n>
void CouplingStepper<n>::note_long_steps(const Case& setup) {
  constexpr double long_step = 3.5;  // in answer times of the wall; from 2 to 3 both cost the same (docs/coupling.md)
  const auto steps = steps_over_answer(setup, scene_);
  if (!steps || steps->adaptive || scene_.has_flow_only() || !(steps->answers > long_step)) return;
  scene_.notices.push_back(fmt::format(
      "{}: partitioned.scheme: a step of {:g} ms is, as its time scheme solves it, {:.2g} times as long as the "
      "wall takes to answer, and \"{}\" takes many passes in such steps; \"iqn-ils\" takes fewer",
      setup.path.string(), steps->length, steps->answers, scheme_.name));
}

template <int n>
StepReport CouplingStepper<n>::advance(State& state) {
  report_ = {};
  report_.outer_iterations = 0;
  coupling_ = {};
  problem_->cost = {};
  const bool started_far = starts_far_;
  const AlternationMonitor march = march_;
  const VelocityGapMonitor velocity_gap = velocity_gap_;
  const auto take_back = [&] {
    accelerator_->abandon();
    starts_far_ = started_far;
    march_ = march;
    velocity_gap_ = velocity_gap;
  };
  const int stages = scene_.integrator->stages(state);
  try {
    for (int stage = 0; stage < stages; ++stage) {
      StepData data = loads_.next(state, *scene_.integrator, stage);
      advance_stage(state, data);
      scene_.settle_openings(state.now, data.rates);
      if (rejects(state, data)) {
        take_back();
        return report_;
      }
      if (keep_balances_) report_.balances.push_back({state.now, data});
      if (data.rates.last_stage)
        accept_level(scene_, data, state);
      else
        scene_.integrator->accept(state, data);
    }
  } catch (const ConvergenceError&) {  // the run may try again with a shorter step
    take_back();
    throw;
  }
  problem_->finish_step();
  steps_ = state.step;
  return report_;
}

template <int n>
void CouplingStepper<n>::advance_stage(State& state, StepData& data) {
  order_ = first_order();
  if (scheme_.one_pass && state.step == 0 && data.rates.stage == 0) check_added_mass(state, data);
  start(state, data);
  note_period(data.rates.interface.period);
  accelerator_->start();
  monitor_.start();
  std::vector<double> x = problem_->first_guess(order_);
  GoodPass good;
  PassAccuracy accuracy{first_tolerance(), starts_far_};
  if (scheme_.one_pass) accuracy = {final_tolerance(), false};
  bool first = true;
  for (passes_ = 1; passes_ <= options_.max_iterations; ++passes_) {
    ++report_.outer_iterations;
    Pass pass;
    try {
      pass = problem_->pass(x, accuracy);
      measure(pass);
      if (!scheme_.one_pass && agrees() &&
          (accuracy.tolerance > std::max(0.1 * demand(), final_tolerance()) || accuracy.linearised_wall)) {
        // Agreement cannot be better than the sub-problems' own accuracy.
        pass = problem_->refine({final_tolerance(), false});
        measure(pass);
      }
    } catch (const PassFailure& failure) {
      retreat(failure, state, data, x, good);
      continue;
    }
    log_pass();
    if (first) starts_far_ = coupling_.displacement_residual > far;
    first = false;
    if (scheme_.one_pass) check_march(state, data);
    if (agrees() || scheme_.one_pass) {
      report_.solver_error = std::max(report_.solver_error, estimated_error(state, data, good));
      accept(x, pass);
      return;
    }
    if (monitor_.diverges(coupling_.displacement_gap)) give_up(state, data, "diverges");
    good.found = true;
    good.x = x;
    good.fields = state.now;
    good.gap = coupling_.displacement_gap;
    accuracy.tolerance =
        std::clamp(sub_problem_share * coupling_.displacement_residual, final_tolerance(), first_tolerance());
    const Stopwatch watch(coupling_.algebra_seconds);
    accelerator_->aim(demand() * space_.norm(pass.displacement));
    accelerator_->correct(x, pass.residual);
    if (accelerator_->allows_change()) accuracy.linearised_wall = coupling_.displacement_residual > far;
  }
  --passes_;
  give_up(state, data, "did not converge");
}

template <int n>
Memory CouplingStepper<n>::memory() const {
  Memory memory = problem_->memory();
  accelerator_->remember(memory);
  memory.numbers["starts_far"] = starts_far_ ? 1 : 0;
  memory.numbers["interface_period"] = period_;
  if (scheme_.one_pass) {
    memory.numbers["steps"] = steps_;
    memory.numbers["alternating_steps"] = march_.steps();
    memory.numbers["last_gap"] = march_.last_gap();
    memory.numbers["steps_apart"] = velocity_gap_.steps();
    memory.numbers["largest_movement"] = velocity_gap_.largest_movement();
  }
  return memory;
}

template <int n>
void CouplingStepper<n>::recall(const Memory& memory) {
  problem_->recall(memory);
  accelerator_->recall(memory);
  const auto number = [&memory](const char* name) {  // 0, as in a new march, where another scheme wrote the checkpoint
    const auto found = memory.numbers.find(name);
    return found == memory.numbers.end() ? 0.0 : found->second;
  };
  period_ = number("interface_period");
  if (memory.numbers.count("starts_far") > 0) starts_far_ = number("starts_far") != 0;
  if (!memory.step_changed) march_.set(static_cast<int>(number("alternating_steps")), number("last_gap"));
  steps_ = static_cast<int>(number("steps"));
  velocity_gap_.set(static_cast<int>(number("steps_apart")), number("largest_movement"));
}

template <int n>
void CouplingStepper<n>::note_period(double period) {
  if (period_ > 0 && period <= likeness * period_ && period_ <= likeness * period) return;
  if (period_ > 0) accelerator_->change(period > period_);
  period_ = period;
  if (!weighs_pressure()) return;
  report_.history.push_back(
      fmt::format("interface: velocities over {:g} ms, where a gap between fluid and wall is worth {:.4g} kPa/mm; "
                  "tolerance {:g} of "
                  "the pressure and of the displacement",
                  period, problem_->pressure_per_gap(), options_.tolerance));
}

template <int n>
double CouplingStepper<n>::demand() const {
  double demand = options_.tolerance;
  if (options_.force_tolerance > 0) demand = std::min(demand, options_.force_tolerance);
  if (weighs_pressure() && coupling_.pressure_residual > coupling_.displacement_residual)
    demand = std::min(demand, options_.tolerance * coupling_.displacement_residual / coupling_.pressure_residual);
  return demand;
}

template <int n>
void CouplingStepper<n>::start(State& state, StepData& data) {
  scene_.integrator->predict(state, order_, data);
  scene_.impose_conditions(state.now);
  scene_.impose_inflows(state, data);
  scene_.impose_interface(state, data.rates);
  problem_->start(state, data);
}

template <int n>
void CouplingStepper<n>::measure(const Pass& pass) {
  coupling_.displacement_gap = space_.norm(pass.residual);
  double size = space_.norm(pass.displacement);
  if (scene_.initial_load)  // displacements count from a loaded shape, also where none move
    if (const auto numbers = space_.size(pass.displacement); numbers > 0)
      size = std::max(size, smallest_motion * problem_->pressure_of_thickness() / problem_->pressure_per_gap() *
                                std::sqrt(static_cast<double>(numbers)));
  coupling_.displacement_residual = size > 0
                                        ? coupling_.displacement_gap / size
                                        : (coupling_.displacement_gap > 0 ? std::numeric_limits<double>::max() : 0.0);
  coupling_.force_residual = problem_->force_residual();
  coupling_.pressure_residual = problem_->pressure_residual(pass.residual);
}

template <int n>
bool CouplingStepper<n>::agrees() const {
  const double residual = weighs_pressure() ? std::max(coupling_.displacement_residual, coupling_.pressure_residual)
                                            : coupling_.displacement_residual;
  return (residual <= options_.tolerance || coupling_.displacement_residual <= displacement_rounding ||
          coupling_.displacement_gap <= options_.absolute_tolerance) &&
         (options_.force_tolerance == 0 || coupling_.force_residual <= options_.force_tolerance);
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
  throw ConvergenceError(
      fmt::format("step {} (to t = {:g} ms): the {} coupling {} in {} iterations, |d~ - d| / |d~| = "
                  "{:.2e}, wanted {:g}; pressure {:.2e}{}; force {:.2e}{}",
                  state.step + 1, data.time, scheme_.name, what, passes_, coupling_.displacement_residual,
                  options_.tolerance, coupling_.pressure_residual,
                  weighs_pressure() ? fmt::format(", wanted {:g}", options_.tolerance) : "", coupling_.force_residual,
                  options_.force_tolerance > 0 ? fmt::format(", wanted {:g}", options_.force_tolerance) : ""),
      scheme_.advice);
}

template <int n>
double CouplingStepper<n>::added_mass(const State& state, const StepData& data) {
  constexpr int passes = 5;           // modes are few and far apart: the longest wave's counts
  constexpr double amplitude = 1e-6;  // of the wall's thickness: the answer is linear
  constexpr PassAccuracy accuracy{1e-4, false};
  State rest = state;
  StepData push = data;
  push.wall_pressure = 0;
  push.opening_flows.clear();
  // What stands behind an opening without flow is taken off: the answer to the push alone counts.
  const auto push_all = [&](double pressure) {
    std::fill(push.opening_pressures.begin(), push.opening_pressures.end(), pressure);
    for (const auto& opening : scene_.openings.answering())
      push.opening_pressures[opening.number] -=
          opening.law->pressure(push.rates.fluid_factor, push.rates.openings_reference.data() + opening.place, 0);
  };
  const double at_rest = scene_.initial_load ? scene_.initial_load->pressure : 0.0;
  if (scene_.initial_load)
    push.support_loads = scene_.initial_load->support_loads;
  else
    std::fill(push.support_loads.begin(), push.support_loads.end(), 0.0);
  double growth = 0;
  try {
    // Pushed by one pressure at all openings the wall moves outward everywhere, as its supports allow.
    start(rest, push);
    push_all(at_rest + amplitude * problem_->pressure_of_thickness());
    std::vector<double> x = problem_->first_guess(0);
    set_zero(x);
    Pass pass = problem_->pass(x, accuracy);
    push_all(at_rest);
    for (int k = 0; k < passes; ++k) {
      const double before = space_.norm(x), length = space_.norm(pass.displacement);
      if (!(length > 0)) break;
      if (k > 0) growth = length / before;
      x = pass.displacement;
      if (k > 0) scale(before / length, x);
      pass = problem_->pass(x, accuracy);
    }
  } catch (const PassFailure&) {
    growth = 0;
  }
  problem_->cost = {};
  return growth;
}

template <int n>
void CouplingStepper<n>::check_added_mass(const State& state, const StepData& data) {
  if (data.rates.is_static()) return;
  const double ratio = added_mass(state, data), limit = std::pow(3, 1 - first_order());
  report_.history.push_back(fmt::format("added mass over the wall's answer: {:.3g}", ratio));
  if (!(ratio > limit)) return;
  throw ConvergenceError(
      fmt::format(
          "step 1 (to t = {:g} ms): the {} coupling is unstable: the fluid's added mass is {:.3g} times what the "
          "wall answers with, more than {:.3g}",
          data.time, scheme_.name, ratio, limit),
      scheme_.advice);
}

template <int n>
std::string CouplingStepper<n>::unchecked() const {
  if (!scheme_.one_pass) return {};
  const int apart = std::max(velocity_gap_.steps(), march_.steps());
  if (steps_ >= VelocityGapMonitor::most_steps && apart == 0) return {};
  const std::string seen = apart > 0 ? fmt::format("; in the last {} of them fluid and wall came apart", apart) : "";
  return fmt::format(
      "the {} coupling claims nothing of {} steps{}: whether fluid and wall hold together shows after {}; "
      "compare with partitioned.scheme = \"iqn-ils\"",
      scheme_.name, steps_, seen, VelocityGapMonitor::most_steps);
}

template <int n>
void CouplingStepper<n>::check_march(const State& state, const StepData& data) {
  const auto give_up = [&](const std::string& what) {
    throw ConvergenceError(
        fmt::format("step {} (to t = {:g} ms): the {} coupling {}", state.step + 1, data.time, scheme_.name, what),
        scheme_.advice);
  };
  if (march_.alternates(coupling_.displacement_gap, coupling_.displacement_residual))
    give_up(
        fmt::format("is unstable: {} steps running the wall has missed the extrapolated displacement by more than "
                    "its own, and further each time (now {:.2e} times)",
                    march_.steps(), coupling_.displacement_residual));
  if (velocity_gap_.comes_apart(coupling_.displacement_gap, problem_->movement()))
    give_up(
        fmt::format("does not hold fluid and wall together, and its pressure is wrong: {} steps running their "
                    "velocities on the interface differ by more than {:g} times the largest so far (now {:.2f} "
                    "times)",
                    velocity_gap_.steps(), options_.velocity_gap, velocity_gap_.last()));
}

template <int n>
void CouplingStepper<n>::retreat(const PassFailure& failure, State& state, StepData& data, std::vector<double>& x,
                                 const GoodPass& good) {
  const bool extrapolated = !good.found && order_ > 0 && state.step > 0;
  ++coupling_.failed_passes;
  report_.history.push_back(fmt::format("coupling {:3d}  no answer from {}", passes_, failure.what()));
  const bool more = !scheme_.one_pass && coupling_.failed_passes <= most_retreats;
  const bool stiffened = more && !good.found && !extrapolated && problem_->stiffen();
  if (!more || (!good.found && !extrapolated && !stiffened)) {
    for (const auto& line : failure.history()) report_.history.push_back(line);
    throw ConvergenceError(
        fmt::format("step {} (to t = {:g} ms): the {} coupling found no answer in pass {}: {}", state.step + 1,
                    data.time, scheme_.name, passes_, failure.what()),
        scheme_.one_pass ? scheme_.advice : "a smaller partitioned.relaxation or a smaller time.step");
  }
  if (extrapolated || stiffened) {
    order_ = 0;  // the extrapolated start can be the culprit, after a jump of the load for example
    start(state, data);
    x = problem_->first_guess(order_);
    return;
  }
  state.now = good.fields;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = good.x[i] + retreat_factor * (x[i] - good.x[i]);
}

template <int n>
double CouplingStepper<n>::estimated_error(const State& state, const StepData& data, const GoodPass& good) const {
  std::vector<double> fluid = state.now.fluid, wall = state.now.wall;
  const auto relative = [&] {
    return relative_to_step<n>(state, data, {fluid_volumes_, fluid}, {wall_volumes_, wall}, scene_.processes());
  };
  const double left = good.found ? coupling_.displacement_gap / good.gap : 1;
  if (left < 1) {
    axpy(-1, good.fields.fluid, fluid);
    axpy(-1, good.fields.wall, wall);
    // A quasi-Newton method knows more with each pass: the next gains at least as much as one that halves.
    const double slowest = accelerator_->status().columns > 0 ? 0.5 : 1;
    const double ratio = std::min(left, slowest);
    return relative() * ratio / (1 - ratio);
  }
  // As large as itself at most: the interface may bear no load, or not move, and has no relative residual then.
  const double displacement = std::min(coupling_.displacement_residual, 1.0);
  const double pressure = std::min(coupling_.pressure_residual, 1.0);
  for (std::size_t i = 0; i < fluid.size(); ++i) fluid[i] *= static_cast<int>(i % (n + 1)) == n ? pressure : 0;
  for (std::size_t i = 0; i < wall.size(); ++i) wall[i] *= static_cast<int>(i % (n + 1)) == n ? pressure : displacement;
  return relative();
}

template <int n>
void CouplingStepper<n>::accept(const std::vector<double>& x, const Pass& pass) {
  {
    const Stopwatch watch(coupling_.algebra_seconds);
    accelerator_->accept(x, pass.residual);
  }
  problem_->accept();
  if (scheme_.one_pass) problem_->follow_wall();
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
