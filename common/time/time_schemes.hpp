#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/name_table.hpp"
#include "base/quantity.hpp"
#include "time/time_integrator.hpp"

namespace fsi {

/// Parameters of a scheme by name, as a case gives them. What is absent has its default.
using SchemeValues = std::map<std::string, double>;

/// A parameter of one scheme: a key of [time].
struct SchemeParameter {
  std::string name;
  std::string about;  ///< with {unit} and {} for the default
  const Quantity* quantity;
  Bounds bounds;
  std::optional<double> standard;  ///< empty: found from the scene
};

/// A row of the table of schemes. All else about a scheme its integrator says.
struct TimeScheme {
  int number;  ///< in checkpoints: never another scheme's
  std::vector<SchemeParameter> parameters;
  /// \param n          components of a vector
  /// \param values     all that have a default, and those that a case gives
  /// \param frequency  of the scene, 1/ms (scene/time_scheme.hpp)
  std::unique_ptr<const TimeIntegrator> (*make)(int n, const SchemeValues& values, double frequency);
};

/// The table, by time.scheme. The first two are those that a case without time.scheme gets one of.
const NameTable<TimeScheme>& time_schemes();
inline constexpr auto scheme_for_short_steps = "midpoint", scheme_for_long_steps = "tr-bdf2";

/// Names of those that bear a coupling of one pass a step (TimeIntegrator::bears_one_pass).
std::vector<std::string> schemes_for_one_pass();

/// \param n          components of a vector
/// \param given      by the case, of this scheme's parameters
/// \param frequency  of the scene, 1/ms
std::unique_ptr<const TimeIntegrator> make_integrator(const std::string& scheme, int n, SchemeValues given,
                                                      double frequency);
/// A scheme without a scene, with its default parameters: for what it says of itself.
std::unique_ptr<const TimeIntegrator> prototype(const std::string& scheme);

}  // namespace fsi
