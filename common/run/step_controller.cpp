#include "run/step_controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "diagnostics/load_path.hpp"
#include "fem/dimensions.hpp"
#include "scene/time_scheme.hpp"
#include "system/step_change.hpp"

namespace fsi {

namespace {

// Of the time that steps must resolve.
constexpr double first_share = 1.0 / 32, largest_share = 1;
constexpr double its_tolerance = 0.01;  // of the first step, which goes with the root of the tolerance

constexpr double same_state = 0.01;   // of what a load step changes
constexpr double same_energy = 1e-3;  // likewise

}  // namespace

// Accelerations are differences over the step's square, and the linear solver's numbers are in single precision.
template <int n>
void require_resolvable(const Case& setup, const Scene<n>& scene) {
  constexpr double smallest = 1e-13;  // of the time in which the scene swings
  if (!setup.time || setup.time->adaptive) return;
  const double swing = scene_time(setup, scene);
  if (setup.time->step >= smallest * swing) return;
  throw InputError(setup.path.string(), "time.step",
                   fmt::format("{:g} ms is too short for the scene's time of {:.3g} ms", setup.time->step, swing),
                   fmt::format("give at least {:.3g} ms", smallest * swing));
}

template <int n>
StepController<n>::StepController(const Case& setup, const Scene<n>& scene, Stepper& stepper, Loads& loads,
                                  std::function<void(const std::string&)> say,
                                  std::function<void(const std::string&)> warn)
    : setup_(setup), scene_(scene), stepper_(stepper), loads_(loads), say_(std::move(say)), warn_(std::move(warn)) {
  if (!warn_) warn_ = say_;
  // A step that may be halved is: quicker, and the message of one that fails comes sooner.
  stepper_.persist(setup.time && !setup.time->adaptive && setup.time->retries == 0);
  if (!loads.axis().is_adaptive()) return;
  keep_scheme();
  stepper_.judge_by(this);
}

template <int n>
void StepController<n>::keep_scheme() {
  if (!loads_.axis().is_adaptive()) return;
  const TimeData& time = *setup_.time;
  const double swing = resolved_time(setup_, scene_);
  StepLimits limits;
  limits.largest = time.largest_step.value_or(largest_share * swing);
  const ErrorTerms terms = scene_.integrator->error_terms();
  const double first = first_share * swing * std::pow(time.tolerance / its_tolerance, 1.0 / terms.order);
  limits.first = time.first_step.value_or(std::min(first, limits.largest));
  limits.smallest = time.smallest_step.value_or(limits.first);
  limits.first = std::max(limits.first, limits.smallest);
  limits.largest = std::max(limits.largest, limits.first);
  controller_.emplace(limits, terms.order);
  const auto volumes = [](const auto& medium) {
    return medium ? owned_volumes<n>(medium->space(), medium->nodes()) : std::vector<double>();
  };
  estimate_.emplace(volumes(scene_.fluid), volumes(scene_.wall), terms, swing, scene_.processes());
}

template <int n>
StepController<n>::~StepController() {
  if (controller_) stepper_.judge_by(nullptr);
}

template <int n>
bool StepController<n>::accepts(const State& state, const StepData& data) {
  errors_ = estimate_->of(state, data);
  const double error = errors_->largest() / setup_.time->tolerance;
  const double length = data.rates.step;
  if (errors_->known && !(error <= 1)) {
    if (controller_->reject(length, error)) return false;
    ++attempts_.beyond;
  }
  if (errors_->known)
    controller_->accept(length, error);
  else
    controller_->accept(length);
  estimate_->accept(data);
  if (data.ends_at_jump) controller_->restart();
  return true;
}

template <int n>
bool StepController<n>::shrink(int step, int failures) {
  if (loads_.axis().is_static()) {
    const StaticData& data = setup_.static_load.value();
    const double shortest = std::exp2(-data.retries) / data.load_steps;
    if (loads_.time_of(step) - loads_.time_of(step - 1) < 1.5 * shortest) return false;
    loads_.axis().halve(step);
    return true;
  }
  if (!stepper_.can_retry() || failures > setup_.time->retries) return false;
  if (controller_) {
    controller_->fail(loads_.step_length(step));
    return true;
  }
  // Parts of a planned step may fail in their turn: its end is where halving began.
  const double shortest = setup_.time->step * std::exp2(-setup_.time->retries);
  if (loads_.step_length(step) < 1.5 * shortest) return false;
  loads_.axis().halve(step);
  return true;
}

template <int n>
std::string StepController<n>::doubt_about(const State& before, const State& after, const StepReport& report) const {
  if (!setup_.static_load->check_path || !scene_.wall) return {};
  if (stays(*scene_.wall, before.before[0].wall, after.before[0].wall)) return {};  // at rest: all else is rounding
  if (report.strayed) return "Newton's method did not go straight to it";
  const LoadPathEnergy energy = load_path_energy(scene_, loads_, after.step, before, after);
  return energy.follows_the_load() ? std::string() : text_of(energy);
}

template <int n>
bool StepController<n>::have_same_energy(const State& before, const State& one, const State& other) const {
  const double a = load_path_energy(scene_, loads_, one.step, before, one).stored;
  const double b = load_path_energy(scene_, loads_, one.step, before, other).stored;
  return std::abs(a - b) <= same_energy * std::max(std::abs(a), std::abs(b));
}

template <int n>
StepReport StepController<n>::load_step(State& state) {
  const State before = state;
  StepReport report = stepper_.advance(state);
  const std::string doubt = doubt_about(before, state, report);
  if (doubt.empty()) return report;
  ++attempts_.checked;
  const State whole = std::exchange(state, before);
  const TimeAxis axis = loads_.axis();
  const auto looked = fmt::format("load step {} (to {:g} of the load) was taken in two halves as well, since {}",
                                  whole.step, whole.time, doubt);
  const auto add = [&report](const StepReport& half) {
    report.newton_iterations += half.newton_iterations;
    report.linear_iterations += half.linear_iterations;
  };
  std::string other;
  loads_.axis().halve(whole.step);
  try {
    for (int half = 0; half < 2; ++half) add(stepper_.advance(state));
    const double apart =
        relative_distance(*scene_.wall, before.before[0].wall, whole.before[0].wall, state.before[0].wall);
    if (!(apart <= same_state) && !have_same_energy(before, whole, state))
      other = fmt::format("they come to another state, {:.2g} % of the step's displacement away", 100 * apart);
  } catch (const ConvergenceError& failure) {
    add(stepper_.report());
    other = fmt::format("they have no solution ({})", failure.what());
  }
  loads_.axis() = axis;
  if (!other.empty()) {
    state = before;
    stepper_.forget();
    throw ConvergenceError(looked + ": " + other, "more static.load_steps, or a smaller load");
  }
  state = whole;
  report.history.push_back(looked + ": they come to the same state");
  if (const auto energy = load_path_energy(scene_, loads_, whole.step, before, whole); !energy.follows_the_load())
    warn_(fmt::format(
        "load step {} (to {:g} of the load): {}, though its two halves come to the same state: the wall has "
        "snapped from one shape to another, or one of the two is not the one that the load leads to; compare "
        "with more static.load_steps",
        whole.step, whole.time, text_of(energy)));
  return report;
}

template <int n>
StepReport StepController<n>::step(State& state) {
  const int step = state.step + 1;
  StepReport spent;  // by attempts that came to nothing
  spent.outer_iterations = 0;
  const auto add = [&spent](const StepReport& report) {
    spent.outer_iterations += report.outer_iterations;
    spent.newton_iterations += report.newton_iterations;
    spent.linear_iterations += report.linear_iterations;
  };
  std::optional<ConvergenceError> first_failure;
  for (int failures = 0;;) {
    if (controller_) loads_.axis().choose(step, state.time, controller_->wanted());
    const double length = loads_.step_length(step);
    try {
      StepReport report = loads_.axis().is_static() ? load_step(state) : stepper_.advance(state);
      if (report.rejected) {
        ++attempts_.rejected;
        add(report);
        say_(fmt::format("step {} rejected with {:.6g} ms: {}; tolerance {:g}", step, length, errors_->text(),
                         setup_.time->tolerance));
        continue;
      }
      report.outer_iterations += spent.outer_iterations;
      report.newton_iterations += spent.newton_iterations;
      report.linear_iterations += spent.linear_iterations;
      return report;
    } catch (const ConvergenceError& failure) {
      ++attempts_.failed;
      if (!first_failure) first_failure = failure;
      if (!shrink(step, ++failures)) {
        loads_.axis().drop_insertions_after(state.step);
        throw ConvergenceError(*first_failure);
      }
      add(stepper_.report());
      if (loads_.axis().is_static()) {
        say_(fmt::format("{}; again up to {:g} of the load", failure.what(), loads_.time_of(step)));
        continue;
      }
      const double next = controller_ ? controller_->wanted() : loads_.step_length(step);
      say_(fmt::format("{}; again with {:.6g} ms in place of {:.6g} ms", failure.what(), next, length));
    }
  }
}

template <int n>
void StepController<n>::keep(RestartArchive& archive) {
  if (!controller_) return;
  if (archive.wants({"controller"})) controller_->keep(archive);
  if (archive.wants({"estimate"})) estimate_->keep(archive);
}

#define FSI_INSTANTIATE(n)                                           \
  template void require_resolvable<n>(const Case&, const Scene<n>&); \
  template class StepController<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
