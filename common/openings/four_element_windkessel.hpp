#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "materials/parameter.hpp"
#include "network/network_quantities.hpp"
#include "openings/opening_law.hpp"

namespace fsi {

/// The Windkessel of four elements ([Stergiopulos1999]): an inertance L beside the proximal resistance carries the flow q
/// of slow changes, so that a steady flow meets the distal resistance alone; y = (p_c, q):
///   p = p_c + R_p (Q - q),   C dp_c/dt = Q - (p_c - p_d) / R_d,   L dq/dt = R_p (Q - q).
class FourElementWindkessel : public OpeningLaw {
 public:
  double proximal = 1;          ///< R_p, kPa ms/mm^3
  double inertance = 1;         ///< L, kPa ms^2/mm^3
  double compliance = 1;        ///< C, mm^3/kPa
  double distal = 1;            ///< R_d, kPa ms/mm^3
  double initial_pressure = 0;  ///< p_c at the start, kPa
  double initial_flow = 0;      ///< q at the start, mm^3/ms
  double distal_pressure = 0;   ///< p_d, kPa

  static constexpr const char* name = "windkessel4";
  static constexpr const char* about = "four elements: a Windkessel with an inertance beside the proximal resistance";
  static std::vector<ParameterOf<FourElementWindkessel>> parameters() {
    using Law = FourElementWindkessel;
    return {{&Law::proximal, "proximal", "resistance before the compliance", quantity::resistance(), positive},
            {&Law::inertance, "inertance", "beside the proximal resistance", quantity::inertance(), positive},
            {&Law::compliance, "compliance", "", quantity::compliance(), positive},
            {&Law::distal, "distal", "resistance behind the compliance", quantity::resistance(), positive},
            {&Law::initial_pressure, "initial_pressure", "of the compliance at the start", quantity::pressure(),
             any_number, false},
            {&Law::initial_flow, "initial_flow", "through the inertance at the start", quantity::flow_rate(),
             any_number, false},
            {&Law::distal_pressure, "distal_pressure", "behind the distal resistance", quantity::pressure(), any_number,
             false}};
  }
  /// Textbooks' letters for its parameters.
  static std::vector<std::pair<std::string, std::string>> letters() {
    return {{"Rp", "proximal"}, {"R1", "proximal"}, {"Rc", "proximal"},        {"Z", "proximal"},
            {"Zc", "proximal"}, {"L", "inertance"}, {"C", "compliance"},       {"Rd", "distal"},
            {"R2", "distal"},   {"R", "distal"},    {"Pd", "distal_pressure"}, {"P0", "initial_pressure"}};
  }

  std::vector<double> start() const override { return {initial_pressure, initial_flow}; }
  std::vector<double> kept(double k, const double* reference, double flow) const override {
    return {stored(k, reference[0], flow), through_inertance(k, reference[1], flow)};
  }
  double pressure(double k, const double* reference, double flow) const override {
    return stored(k, reference[0], flow) + proximal * (flow - through_inertance(k, reference[1], flow));
  }
  double slope(double k) const override {
    const double delay = inertance * k;
    return proximal * delay / (delay + proximal) + 1 / (compliance * k + 1 / distal);
  }
  std::vector<double> rates(const double* kept, double flow) const override {
    return {(flow - (kept[0] - distal_pressure) / distal) / compliance, proximal * (flow - kept[1]) / inertance};
  }

  double pressure_behind(const double* kept) const override { return kept[0]; }
  double time_constant() const override { return std::max(distal * compliance, inertance / proximal); }
  std::string description(const std::string& volume) const override {
    std::string text = fmt::format(
        "Windkessel of four elements: proximal {:g}, distal {:g} kPa ms/{}, inertance {:g} kPa ms^2/{}, compliance "
        "{:g} "
        "{}/kPa, from {:g} kPa",
        proximal, distal, volume, inertance, volume, compliance, volume, initial_pressure);
    if (initial_flow != 0) text += fmt::format(" and {:g} {}/ms", initial_flow, volume);
    return distal_pressure == 0 ? text : text + fmt::format(" above {:g} kPa", distal_pressure);
  }

 private:
  /// p_c at a balance.
  double stored(double k, double reference, double flow) const {
    return (compliance * k * reference + distal_pressure / distal + flow) / (compliance * k + 1 / distal);
  }
  /// q at a balance.
  double through_inertance(double k, double reference, double flow) const {
    return (inertance * k * reference + proximal * flow) / (inertance * k + proximal);
  }
};

}  // namespace fsi
