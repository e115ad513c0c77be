#include "time/time_schemes.hpp"

#include <stdexcept>
#include <utility>

#include "time/bdf2.hpp"
#include "time/euler_newmark.hpp"
#include "time/generalised_alpha.hpp"
#include "time/shifted_midpoint.hpp"
#include "time/tr_bdf2.hpp"

namespace fsi {

namespace {

using Made = std::unique_ptr<const TimeIntegrator>;
using Values = SchemeValues;

/// Calls make with n as a constant of the compiler.
template <class Make>
Made for_components(int n, Make make) {
  switch (n) {
    case 1:
      return make(std::integral_constant<int, 1>());
    case 2:
      return make(std::integral_constant<int, 2>());
    case 3:
      return make(std::integral_constant<int, 3>());
  }
  throw std::logic_error("vectors have one to three components");
}

template <template <int> class Scheme>
Made plain(int n, const Values&, double) {
  return for_components(n, [](auto k) -> Made { return std::make_unique<Scheme<k>>(); });
}

Made euler(int n, const Values& values, double) {
  const NewmarkParameters newmark{values.at("newmark_beta"), values.at("newmark_gamma")};
  return for_components(n, [&](auto k) -> Made { return std::make_unique<EulerNewmark<k>>(newmark); });
}

Made generalised_alpha(int n, const Values& values, double) {
  const double rho = values.at("spectral_radius");
  return for_components(n, [&](auto k) -> Made { return std::make_unique<GeneralisedAlpha<k>>(rho); });
}

Made midpoint(int n, const Values& values, double frequency) {
  const auto damping = values.find("damping");
  return for_components(n, [&](auto k) -> Made {
    if (damping != values.end()) return std::make_unique<ShiftedMidpoint<k>>(damping->second);
    return ShiftedMidpoint<k>::of_scene(frequency);
  });
}

}  // namespace

const NameTable<TimeScheme>& time_schemes() {
  static const Bounds newmark{0, 1, false, true};
  static const NameTable<TimeScheme> table{
      "time.scheme",
      {{"midpoint",
        {1,
         {{"damping",
           "rate in {unit} of the shift of the midpoint rule towards the step's end; without it found from the scene",
           &quantity::rate(), Bounds{0, 1e6, true, true}, std::nullopt}},
         midpoint}},
       {"tr-bdf2", {4, {}, plain<TrBdf2>}},
       {"bdf2", {2, {}, plain<Bdf2>}},
       {"generalised-alpha",
        {3,
         {{"spectral_radius",
           "of generalised-alpha at infinite frequency, default {}; more than 0.5 lets pressures ring",
           &quantity::number(), Bounds{0, 1, true, true}, 0.5}},
         generalised_alpha}},
       {"euler",
        {0,
         {{"newmark_beta", "Newmark's beta of the wall, default {}", &quantity::number(), newmark, 1},
          {"newmark_gamma", "Newmark's gamma of the wall, default {}", &quantity::number(), newmark, 1}},
         euler}}}};
  return table;
}

Made make_integrator(const std::string& scheme, int n, SchemeValues given, double frequency) {
  const TimeScheme& row = time_schemes().at(scheme);
  for (const SchemeParameter& parameter : row.parameters)
    if (parameter.standard) given.emplace(parameter.name, *parameter.standard);
  return row.make(n, given, frequency);
}

std::vector<std::string> schemes_for_one_pass() {
  std::vector<std::string> names;
  for (const std::string& name : time_schemes().names())
    if (prototype(name)->bears_one_pass()) names.push_back(name);
  return names;
}

Made prototype(const std::string& scheme) {
  return make_integrator(scheme, 1, {}, 1);
}

}  // namespace fsi
