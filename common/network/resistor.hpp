#pragma once

#include <fmt/format.h>

#include <vector>

#include "materials/parameter.hpp"
#include "network/network_element.hpp"

namespace fsi {

/// dp = R q.
class Resistor : public NetworkElement {
 public:
  double resistance = 1;  ///< R, kPa ms/mm^3

  static constexpr const char* name = "resistor";
  static std::vector<ParameterOf<Resistor>> parameters() {
    return {
        {&Resistor::resistance, "resistance", "drop of the pressure over the flow", quantity::resistance(), positive}};
  }

  Equation equation(const NetworkMoment&, double, double drop, double flow) const override {
    return {resistance * flow - drop, -1, resistance};
  }
  std::string description(const std::string& volume) const override {
    return fmt::format("resistance {:g} kPa ms/{}", resistance, volume);
  }
};

}  // namespace fsi
