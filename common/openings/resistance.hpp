#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "materials/parameter.hpp"
#include "openings/opening_law.hpp"

namespace fsi {

/// p = p_d + R Q; nothing is kept.
class Resistance : public OpeningLaw {
 public:
  double resistance = 0;       ///< R, kPa ms/mm^3
  double distal_pressure = 0;  ///< p_d, kPa

  static constexpr const char* name = "resistance";
  static std::vector<ParameterOf<Resistance>> parameters() {
    using Law = Resistance;
    return {
        {&Law::resistance, "resistance", "pressure over outward flow", quantity::resistance(), not_negative},
        {&Law::distal_pressure, "distal_pressure", "behind the resistance", quantity::pressure(), any_number, false}};
  }

  std::vector<double> start() const override { return {}; }
  std::vector<double> kept(double, const double*, double) const override { return {}; }
  double pressure(double, const double*, double flow) const override { return distal_pressure + resistance * flow; }
  double slope(double) const override { return resistance; }
  std::vector<double> rates(const double*, double) const override { return {}; }

  double pressure_behind(const double*) const override { return distal_pressure; }
  double time_constant() const override { return 0; }
  std::string description(const std::string& volume) const override {
    std::string text = fmt::format("resistance {:g} kPa ms/{}", resistance, volume);
    return distal_pressure == 0 ? text : text + fmt::format(" above {:g} kPa", distal_pressure);
  }
};

}  // namespace fsi
