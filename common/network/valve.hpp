#pragma once

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "materials/parameter.hpp"
#include "network/network_element.hpp"
#include "network/network_quantities.hpp"

namespace fsi {

/// A valve, open from its first end to its second. Closed it leaks; it opens over a width w of the drop, so that the
/// flow is a smooth function of the drop:
///   q = (l + (1 - l) s(dp / w)) q_o(dp),   s(x) = 3 x^2 - 2 x^3 in [0, 1], 0 before, 1 behind,
///   q_o: R q_o + B |q_o| q_o = dp.
/// The flow has the sign of the drop and grows with it: the valve dissipates, and a network of such has one solution.
/// The quadratic loss is that of [Mynard2012].
class Valve : public NetworkElement {
 public:
  double resistance = 1;  ///< R of the open one, kPa ms/mm^3
  double quadratic = 0;   ///< B of the open one, kPa ms^2/mm^6
  double leak = 1e-6;     ///< l: flow of the closed one over that of the open one
  double width = 0.01;    ///< w, kPa

  static constexpr const char* name = "valve";
  static std::vector<ParameterOf<Valve>> parameters() {
    using E = Valve;
    return {{&E::resistance, "resistance", "of the open one", quantity::resistance(), positive},
            {&E::quadratic, "quadratic", "drop of the pressure over the square of the flow, of the open one",
             quantity::quadratic_resistance(), not_negative, false},
            {&E::leak, "leak", "flow of the closed one over that of the open one", quantity::number(),
             Bounds{1e-10, 0.1, true, true}, false},
            {&E::width, "width", "drop of the pressure over which it opens", quantity::pressure(), positive, false}};
  }

  Equation equation(const NetworkMoment&, double, double drop, double flow) const override {
    const double root = std::sqrt(resistance * resistance + 4 * quadratic * std::abs(drop));
    const double open = 2 * drop / (resistance + root), open_slope = 1 / root;
    const double x = drop / width;
    double s = x < 1 ? 0 : 1, s_slope = 0;
    if (x > 0 && x < 1) {
      s = x * x * (3 - 2 * x);
      s_slope = 6 * x * (1 - x) / width;
    }
    const double passes = leak + (1 - leak) * s;
    return {flow - passes * open, -(passes * open_slope + (1 - leak) * s_slope * open), 1};
  }
  bool switches() const override { return true; }
  double resistance_of_residual() const override { return resistance; }
  std::string description(const std::string& volume) const override {
    return fmt::format("open {:g} kPa ms/{}{}, opens over {:g} kPa, closed it leaks {:g} of that", resistance, volume,
                       quadratic > 0 ? fmt::format(" and {:g} kPa ms^2/{}^2", quadratic, volume) : "", width, leak);
  }
};

/// A valve without quadratic loss.
class Diode : public Valve {
 public:
  static constexpr const char* name = "diode";
  static std::vector<ParameterOf<Diode>> parameters() {
    std::vector<ParameterOf<Diode>> parameters;
    for (const auto& p : Valve::parameters())
      if (p.member != &Valve::quadratic)
        parameters.push_back(
            {static_cast<double Diode::*>(p.member), p.name, p.about, p.quantity, p.bounds, p.required});
    return parameters;
  }
};

}  // namespace fsi
