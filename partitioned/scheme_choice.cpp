#include "partitioned/scheme_choice.hpp"

#include <fmt/format.h>

#include "fem/dimensions.hpp"
#include "partitioned/interface/membrane.hpp"
#include "partitioned/interface/wetted_sides.hpp"

namespace fsi {

namespace {

/// Answer times of the wall in the period of a step up to which it is short (docs/coupling.md).
constexpr double long_step = 2;
/// The same for the longest that adaptive steps may be: most of them are less than half as long.
constexpr double long_adaptive_step = 2 * long_step;

}  // namespace

template <int n>
std::optional<StepsOverAnswer> steps_over_answer(const Case& setup, const Scene<n>& scene) {
  if (!setup.time || !scene.coupled()) return std::nullopt;
  if (setup.time->adaptive && !setup.time->largest_step) return std::nullopt;
  StepsOverAnswer steps;
  steps.adaptive = setup.time->adaptive;
  steps.length = steps.adaptive ? *setup.time->largest_step : setup.time->step;
  steps.period = scene.integrator->period(steps.length);
  steps.answers = steps.period / membrane_of(scene).answer_time();
  return steps;
}

template <int n>
RobinStiffness robin_stiffness(const Case& setup, const Scene<n>& scene) {
  constexpr double in_short_steps = 1, in_long_steps = 10, in_the_fluid = 1e4;
  if (wetted_sides_of(scene).stands_in_the_fluid())
    return {in_the_fluid, "the wall stands in the fluid, and is no tube around it"};
  if (!setup.time) return {in_short_steps, "a static case has no steps"};
  const auto steps = steps_over_answer(setup, scene);
  if (!steps) return {in_short_steps, "adaptive steps are mostly short against the time within which the wall answers"};
  const double limit = steps->adaptive ? long_adaptive_step : long_step;
  const bool is_long = steps->answers > limit;
  return {is_long ? in_long_steps : in_short_steps,
          fmt::format(
              "{} of {:.3g} ms is, as its time scheme solves it, {:.3g} times as long as the wall takes to answer, {} "
              "than {:g}",
              steps->adaptive ? "the longest step" : "a step", steps->length, steps->answers,
              is_long ? "more" : "no more", limit)};
}

template <int n>
SchemeChoice chosen_scheme(const Case& setup, const Scene<n>& scene) {
  if (const auto& named = setup.partitioned.scheme) return {*named, "named by the case", true};
  if (!wetted_sides_of(scene).stands_in_the_fluid()) return {"robin-neumann-inexact", "the case names none"};
  if (scene.has_flow_only())
    return {"robin-neumann-iqn", "the case names none, the wall stands in the fluid, and no opening sets its pressure"};
  return {"iqn-ils", "the case names none, and the wall stands in the fluid"};
}

#define FSI_INSTANTIATE(n)                                                                                \
  template SchemeChoice chosen_scheme<n>(const Case& setup, const Scene<n>& scene);                       \
  template std::optional<StepsOverAnswer> steps_over_answer<n>(const Case& setup, const Scene<n>& scene); \
  template RobinStiffness robin_stiffness<n>(const Case& setup, const Scene<n>& scene);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
