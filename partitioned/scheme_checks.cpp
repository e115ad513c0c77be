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

}  // namespace

void note_foreign_options(const CouplingScheme& scheme, const Case& setup, std::vector<std::string>& notices) {
  const PartitionedData& given = setup.partitioned;
  const PartitionedData standard;
  const auto note = [&](unsigned option, bool is_given, const char* key, const char* whose) {
    if (is_given && (scheme.options & option) == 0)
      notices.push_back(fmt::format("{}: partitioned.{} has no effect with partitioned.scheme = \"{}\": it is for {}",
                                    setup.path.string(), key, scheme.name, whose));
  };
  constexpr auto by_gap =
      "schemes that end by the gap between fluid and wall, and this one ends by the error of a step";
  note(option::gap_demands, given.tolerance_of != standard.tolerance_of, "tolerance_of", by_gap);
  note(option::gap_demands, given.absolute_tolerance != standard.absolute_tolerance, "absolute_tolerance", by_gap);
  note(option::force_tolerance, given.force_tolerance != standard.force_tolerance, "force_tolerance",
       "interface schemes; here the balance is a part of the residual");
  note(option::velocity_gap, given.velocity_gap != standard.velocity_gap, "velocity_gap", "\"explicit\"");
  note(option::robin_coefficient, given.robin_coefficient.has_value(), "robin_coefficient",
       "the schemes that begin with robin-robin");
  note(option::relaxation, given.relaxation.has_value(), "relaxation", "interface schemes");
  note(option::filter, given.quasi_newton.filter != standard.quasi_newton.filter, "filter",
       "quasi-Newton schemes that drop differences");
  note(option::columns, given.quasi_newton.columns != standard.quasi_newton.columns, "columns", "quasi-Newton schemes");
}

void require_moving_start(const CouplingScheme& scheme, const Case& setup, int order) {
  if (order > 0) return;
  throw InputError(
      setup.path.string(), "time.predictor",
      fmt::format("0 with partitioned.scheme = \"{}\": the fluid would see a wall that never moves", scheme.name),
      "use 1 or 2");
}

void refuse_time_scheme(const CouplingScheme& scheme, const Case& setup, const std::string& time_scheme,
                        const char* why, const std::string& remedy) {
  throw InputError(setup.path.string(), "time.scheme",
                   fmt::format("\"{}\" with partitioned.scheme = \"{}\": {}", time_scheme, scheme.name, why), remedy);
}

template <int n>
void require_scheme_for_one_pass(const CouplingScheme& scheme, const Case& setup, const Scene<n>& scene) {
  if (scene.integrator->bears_one_pass()) return;
  std::vector<std::string> others;
  for (const std::string& name : schemes_for_one_pass()) others.push_back("\"" + name + "\"");
  refuse_time_scheme(
      scheme, setup, time_scheme_of(setup, scene),
      "what one pass leaves between fluid and wall comes back with every step, and the pressure is wrong",
      "use " + one_of(others) + ", or a coupling scheme that iterates");
}

template <int n>
void require_for_loose(const CouplingScheme& scheme, const Case& setup, Scene<n>& scene) {
  if (!setup.time)
    throw InputError(
        setup.path.string(), "partitioned.scheme",
        fmt::format("\"{}\" solves each medium once a step, and in a static case they do not agree then", scheme.name),
        "use a scheme that iterates: \"block-newton\"");
  if (!setup.partitioned.robin_coefficient && wetted_sides_of(scene).stands_in_the_fluid())
    scene.notices.push_back(
        fmt::format("{}: partitioned.scheme: \"{}\" takes its coefficient from a wall that is a tube around the fluid, "
                    "and this one stands in the fluid; give partitioned.robin_coefficient, or name \"iqn-ils\"",
                    setup.path.string(), scheme.name));
}

template <int n>
bool determines_pressure(const Scene<n>& scene) {
  for (const auto& remark : scene.remarks)
    if (remark.rfind(interface_takes_equations, 0) == 0) return false;
  return !scene.coupled() || !scene.has_flow_only();
}

template <int n>
void require_determined_pressure(const CouplingScheme& scheme, const Case& setup, const Scene<n>& scene) {
  if (scene.coupled() && scene.has_flow_only())
    throw InputError(setup.path.string(), "partitioned.scheme",
                     fmt::format("\"{}\" gives the fluid its velocity on the wall, and the case does so at every "
                                 "opening: its pressure is not determined",
                                 scheme.name),
                     "use a scheme that begins with robin-neumann, or give one opening a pressure, a resistance or a "
                     "windkessel");
  for (const auto& remark : scene.remarks)
    if (remark.rfind(interface_takes_equations, 0) == 0)
      throw InputError(setup.path.string(), "partitioned.scheme", fmt::format("\"{}\": {}", scheme.name, remark),
                       "a scheme that begins with robin-neumann, and fsi-monolithic, leave it free");
}

template <int n>
void note_where_robin_neumann_is_slow(const CouplingScheme& scheme, const Case& setup, Scene<n>& scene) {
  if (wetted_sides_of(scene).stands_in_the_fluid())
    scene.notices.push_back(fmt::format(
        "{}: partitioned.scheme: \"{}\" takes the wall for a tube around the fluid, and this one stands in the fluid, "
        "so that steps may find no solution; {}",
        setup.path.string(), scheme.name,
        scene.has_flow_only() ? "give one opening a pressure, a resistance or a windkessel, and name \"iqn-ils\""
                              : "name \"iqn-ils\""));
  else
    note_long_steps(scheme, setup, scene);
}

template <int n>
void require_tube(const CouplingScheme& scheme, const Case& setup, const Scene<n>& scene) {
  if (!wetted_sides_of(scene).stands_in_the_fluid()) return;
  throw InputError(
      setup.path.string(), "partitioned.scheme",
      fmt::format("\"{}\" takes the wall for a tube around the fluid, and this one stands in the fluid: its "
                  "passes, which solve each medium in part, cannot tell there how far they are from the end",
                  scheme.name),
      scene.has_flow_only() ? "name none, or \"robin-neumann-iqn\" or \"block-newton\""
                            : "name none, or \"iqn-ils\" or \"block-newton\"");
}

#define FSI_INSTANTIATE(n)                                                                           \
  template void require_scheme_for_one_pass<n>(const CouplingScheme&, const Case&, const Scene<n>&); \
  template bool determines_pressure<n>(const Scene<n>&);                                             \
  template void require_for_loose<n>(const CouplingScheme&, const Case&, Scene<n>&);                 \
  template void require_determined_pressure<n>(const CouplingScheme&, const Case&, const Scene<n>&); \
  template void note_where_robin_neumann_is_slow<n>(const CouplingScheme&, const Case&, Scene<n>&);  \
  template void require_tube<n>(const CouplingScheme&, const Case&, const Scene<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
