#include "partitioned/scheme_checks.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/names.hpp"
#include "fem/dimensions.hpp"
#include "partitioned/interface/wetted_sides.hpp"
#include "partitioned/scheme_choice.hpp"
#include "scene/pressure_equations.hpp"
#include "scene/time_scheme.hpp"
#include "time/time_schemes.hpp"

namespace fsi {

namespace {

/// One pass a step needs an extrapolation, and a time scheme that forgives what it leaves.
template <int n>
void require_for_one_pass(const CouplingScheme& scheme, const Case& setup, int order, const Scene<n>& scene) {
  const bool fluid_follows = scheme.loose == Loose::in_turn || scheme.loose == Loose::corrected;
  if (order == 0 && !fluid_follows)
    throw InputError(
        setup.path.string(), "time.predictor",
        fmt::format("0 with partitioned.scheme = \"{}\": the fluid would see a wall that never moves", scheme.name),
        "use 1 or 2");
  if (scene.integrator->bears_one_pass()) return;
  std::vector<std::string> others;
  for (const std::string& name : schemes_for_one_pass()) others.push_back("\"" + name + "\"");
  throw InputError(setup.path.string(), "time.scheme",
                   fmt::format("\"{}\" with partitioned.scheme = \"{}\": what one pass leaves between fluid and wall "
                               "comes back with every step, and the pressure is wrong",
                               time_scheme_of(setup, scene), scheme.name),
                   "use " + one_of(others) + ", or a coupling scheme that iterates");
}

/// Notes where Robin-Neumann, made for short steps, meets long ones.
template <int n>
void note_long_steps(const CouplingScheme& scheme, const Case& setup, Scene<n>& scene) {
  constexpr double long_step = 3.5;  // in answer times of the wall; from 2 to 3 both cost the same (docs/coupling.md)
  const auto steps = steps_over_answer(setup, scene);
  if (!steps || steps->adaptive || scene.has_flow_only() || !(steps->answers > long_step)) return;
  scene.notices.push_back(fmt::format(
      "{}: partitioned.scheme: a step of {:g} ms is, as its time scheme solves it, {:.2g} times as long as the "
      "wall takes to answer, and \"{}\" takes many passes in such steps; \"iqn-ils\" takes fewer",
      setup.path.string(), steps->length, steps->answers, scheme.name));
}

/// Loosely coupled Robin-Robin schemes march in time. With data of the last step on both sides pressures ring, the more with
/// schemes that damp less than backward Euler (docs/coupling.md).
template <int n>
void require_for_loose(const CouplingScheme& scheme, const Case& setup, Scene<n>& scene) {
  const std::string file = setup.path.string();
  if (!setup.time)
    throw InputError(
        file, "partitioned.scheme",
        fmt::format("\"{}\" solves each medium once a step, and in a static case they do not agree then", scheme.name),
        "use a scheme that iterates: \"block-newton\"");
  const std::string time_scheme = time_scheme_of(setup, scene);
  if (scheme.loose == Loose::at_once && time_scheme != "euler")
    throw InputError(
        file, "time.scheme",
        fmt::format("\"{}\" with partitioned.scheme = \"{}\": each medium has the other's data of the last "
                    "step alone, and the pressure rings",
                    time_scheme, scheme.name),
        "use \"euler\", or another coupling scheme: \"robin-robin\"");
  if (scheme.loose == Loose::corrected && time_scheme == "generalised-alpha")
    throw InputError(
        file, "time.scheme",
        fmt::format("\"{}\" with partitioned.scheme = \"{}\": what a jump of the load leaves is damped too little, and "
                    "the correction drives it on: the pressure rings",
                    time_scheme, scheme.name),
        "use \"bdf2\" or \"euler\", or another coupling scheme: \"robin-robin\"");
  if (!setup.partitioned.robin_coefficient && wetted_sides_of(scene).stands_in_the_fluid())
    scene.notices.push_back(
        fmt::format("{}: partitioned.scheme: \"{}\" takes its coefficient from a wall that is a tube around the fluid, "
                    "and this one stands in the fluid; give partitioned.robin_coefficient, or name \"iqn-ils\"",
                    file, scheme.name));
}

/// An extrapolated domain is one in time.
void require_time(const CouplingScheme& scheme, const Case& setup) {
  if (setup.time) return;
  throw InputError(
      setup.path.string(), "partitioned.scheme",
      fmt::format("\"{}\" extrapolates the fluid's domain in time, and a static case has none", scheme.name),
      "use \"block-newton\"");
}

}  // namespace

void note_foreign_options(const std::string& scheme, const Case& setup, std::vector<std::string>& notices) {
  const PartitionedData& given = setup.partitioned;
  const PartitionedData standard;
  const bool block = scheme == "block-newton", inexact = scheme == "robin-neumann-inexact";
  const bool robin_robin = scheme.rfind("robin-robin", 0) == 0, by_error = block || inexact;
  const bool keeps_differences = scheme.find("iqn") != std::string::npos || scheme == "robin-neumann-imvj" ||
                                 scheme == "newton-krylov" || scheme == "semi-implicit" || robin_robin || by_error;
  const auto note = [&](bool foreign, const char* key, const char* whose) {
    if (foreign)
      notices.push_back(fmt::format("{}: partitioned.{} has no effect with partitioned.scheme = \"{}\": it is {}",
                                    setup.path.string(), key, scheme, whose));
  };
  note(by_error && given.tolerance_of != standard.tolerance_of, "tolerance_of",
       "for schemes that end by the gap between fluid and wall, and this one ends by the error of a step");
  note(by_error && given.absolute_tolerance != standard.absolute_tolerance, "absolute_tolerance",
       "for schemes that end by the gap between fluid and wall, and this one ends by the error of a step");
  note(block && given.force_tolerance != standard.force_tolerance, "force_tolerance",
       "for interface schemes; here the balance is a part of the residual");
  note(scheme != "explicit" && given.velocity_gap != standard.velocity_gap, "velocity_gap", "for \"explicit\"");
  note(!robin_robin && given.robin_coefficient, "robin_coefficient", "for the schemes that begin with robin-robin");
  note(block && given.relaxation, "relaxation", "for interface schemes");
  note((inexact || !keeps_differences) && given.quasi_newton.filter != standard.quasi_newton.filter, "filter",
       "for quasi-Newton schemes that drop differences");
  note(!keeps_differences && given.quasi_newton.columns != standard.quasi_newton.columns, "columns",
       "for quasi-Newton schemes");
}

template <int n>
void check_scheme(const CouplingScheme& scheme, const Case& setup, int order, Scene<n>& scene) {
  if (scheme.loose != Loose::no) require_for_loose(scheme, setup, scene);
  if (scheme.one_pass) require_for_one_pass(scheme, setup, order, scene);
  if (scheme.extrapolates_domain) require_time(scheme, setup);
  const bool given_velocity = !scheme.robin && scheme.loose == Loose::no;
  if (given_velocity && scene.coupled() && scene.has_flow_only())
    throw InputError(setup.path.string(), "partitioned.scheme",
                     fmt::format("\"{}\" gives the fluid its velocity on the wall, and the case does so at every "
                                 "opening: its pressure is not determined",
                                 scheme.name),
                     "use a scheme that begins with robin-neumann, or give one opening a pressure, a resistance or a "
                     "windkessel");
  for (const auto& remark : scene.remarks)
    if (given_velocity && remark.rfind(interface_takes_equations, 0) == 0)
      throw InputError(setup.path.string(), "partitioned.scheme", fmt::format("\"{}\": {}", scheme.name, remark),
                       "a scheme that begins with robin-neumann, and fsi-monolithic, leave it free");
  if (scheme.robin && wetted_sides_of(scene).stands_in_the_fluid())
    scene.notices.push_back(fmt::format(
        "{}: partitioned.scheme: \"{}\" takes the wall for a tube around the fluid, and this one stands in the fluid, "
        "so that steps may find no solution; {}",
        setup.path.string(), scheme.name,
        scene.has_flow_only() ? "give one opening a pressure, a resistance or a windkessel, and name \"iqn-ils\""
                              : "name \"iqn-ils\""));
  else if (scheme.robin)
    note_long_steps(scheme, setup, scene);
}

#define FSI_INSTANTIATE(n) template void check_scheme<n>(const CouplingScheme&, const Case&, int, Scene<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
