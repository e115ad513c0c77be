#pragma once

#include <fmt/format.h>

#include <vector>

#include "materials/parameter.hpp"
#include "network/network_element.hpp"
#include "network/network_quantities.hpp"

namespace fsi {

/// dV/dt = q, V = V_0 + C dp; y = V.
class Capacitor : public NetworkElement {
 public:
  double compliance = 1;         ///< C, mm^3/kPa
  double initial_pressure = 0;   ///< dp at the start, kPa
  double unstressed_volume = 0;  ///< V_0, mm^3

  static constexpr const char* name = "capacitor";
  static std::vector<ParameterOf<Capacitor>> parameters() {
    using E = Capacitor;
    return {
        {&E::compliance, "compliance", "volume stored over the drop of the pressure", quantity::compliance(), positive},
        {&E::initial_pressure, "initial_pressure", "drop of the pressure at the start", quantity::pressure(),
         any_number, false},
        {&E::unstressed_volume, "unstressed_volume", "stored without pressure", quantity::volume(), not_negative,
         false}};
  }

  Equation equation(const NetworkMoment& at, double reference, double drop, double flow) const override {
    return {compliance * drop + unstressed_volume - reference - at.lag * flow, compliance, -at.lag};
  }
  Keeps keeps() const override { return Keeps::volume; }
  double start() const override { return unstressed_volume + compliance * initial_pressure; }
  double kept(const NetworkMoment& at, double reference, double, double flow) const override {
    return reference + at.lag * flow;
  }
  double rate(double, double flow) const override { return flow; }
  std::string description(const std::string& volume) const override {
    return fmt::format("compliance {:g} {}/kPa, from {:g} kPa", compliance, volume, initial_pressure);
  }
};

}  // namespace fsi
