#pragma once

#include <fmt/format.h>

#include <vector>

#include "materials/parameter.hpp"
#include "network/network_element.hpp"
#include "network/network_quantities.hpp"

namespace fsi {

/// L dq/dt = dp; y = q.
class Inductor : public NetworkElement {
 public:
  double inertance = 1;     ///< L, kPa ms^2/mm^3
  double initial_flow = 0;  ///< q at the start, mm^3/ms

  static constexpr const char* name = "inductor";
  static std::vector<ParameterOf<Inductor>> parameters() {
    using E = Inductor;
    return {
        {&E::inertance, "inertance", "drop of the pressure over the rate of the flow", quantity::inertance(), positive},
        {&E::initial_flow, "initial_flow", "at the start", quantity::flow_rate(), any_number, false}};
  }

  Equation equation(const NetworkMoment& at, double reference, double drop, double flow) const override {
    return {flow - reference - at.lag / inertance * drop, -at.lag / inertance, 1};
  }
  Keeps keeps() const override { return Keeps::flow; }
  double start() const override { return initial_flow; }
  double kept(const NetworkMoment& at, double reference, double drop, double) const override {
    return reference + at.lag / inertance * drop;
  }
  double rate(double drop, double) const override { return drop / inertance; }
  std::string description(const std::string& volume) const override {
    return fmt::format("inertance {:g} kPa ms^2/{}, from {:g} {}/ms", inertance, volume, initial_flow, volume);
  }
};

}  // namespace fsi
