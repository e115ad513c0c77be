#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "materials/parameter.hpp"
#include "openings/opening_law.hpp"

namespace fsi {

/// The Windkessel of three elements ([Westerhof2009]), y = p_c:
///   p = p_c + R_p Q,   C dp_c/dt = Q - (p_c - p_d) / R_d.
class Windkessel : public OpeningLaw {
 public:
  double proximal = 0;          ///< R_p, kPa ms/mm^3
  double compliance = 1;        ///< C, mm^3/kPa
  double distal = 1;            ///< R_d, kPa ms/mm^3
  double initial_pressure = 0;  ///< p_c at the start, kPa
  double distal_pressure = 0;   ///< p_d, kPa

  static constexpr const char* name = "windkessel";
  static constexpr const char* about = "proximal resistance, compliance and distal resistance";
  static std::vector<ParameterOf<Windkessel>> parameters() {
    using Law = Windkessel;
    return {{&Law::proximal, "proximal", "resistance before the compliance", quantity::resistance(), not_negative},
            {&Law::compliance, "compliance", "", quantity::compliance(), positive},
            {&Law::distal, "distal", "resistance behind the compliance", quantity::resistance(), positive},
            {&Law::initial_pressure, "initial_pressure", "of the compliance at the start", quantity::pressure(),
             any_number, false},
            {&Law::distal_pressure, "distal_pressure", "behind the distal resistance", quantity::pressure(), any_number,
             false}};
  }
  /// Textbooks' letters for its parameters.
  static std::vector<std::pair<std::string, std::string>> letters() {
    return {{"Rp", "proximal"}, {"R1", "proximal"},        {"Rc", "proximal"},        {"Z", "proximal"},
            {"Zc", "proximal"}, {"C", "compliance"},       {"Rd", "distal"},          {"R2", "distal"},
            {"R", "distal"},    {"Pd", "distal_pressure"}, {"P0", "initial_pressure"}};
  }

  std::vector<double> start() const override { return {initial_pressure}; }
  std::vector<double> kept(double k, const double* reference, double flow) const override {
    return {stored(k, reference[0], flow)};
  }
  double pressure(double k, const double* reference, double flow) const override {
    return stored(k, reference[0], flow) + proximal * flow;
  }
  double slope(double k) const override { return proximal + 1 / (compliance * k + 1 / distal); }
  std::vector<double> rates(const double* kept, double flow) const override {
    return {(flow - (kept[0] - distal_pressure) / distal) / compliance};
  }

  double pressure_behind(const double* kept) const override { return kept[0]; }
  double time_constant() const override { return distal * compliance; }
  std::string description(const std::string& volume) const override {
    std::string text =
        fmt::format("Windkessel: proximal {:g}, distal {:g} kPa ms/{}, compliance {:g} {}/kPa, from {:g} kPa", proximal,
                    distal, volume, compliance, volume, initial_pressure);
    return distal_pressure == 0 ? text : text + fmt::format(" above {:g} kPa", distal_pressure);
  }

 private:
  /// p_c at a balance.
  double stored(double k, double reference, double flow) const {
    return (compliance * k * reference + distal_pressure / distal + flow) / (compliance * k + 1 / distal);
  }
};

}  // namespace fsi
