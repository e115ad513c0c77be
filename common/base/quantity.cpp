#include "base/quantity.hpp"

#include <fmt/format.h>

#include <cmath>

namespace fsi {

namespace {

bool is_half_line(const Bounds& bounds) {
  return bounds.low == 0 && bounds.high == std::numeric_limits<double>::infinity();
}

}  // namespace

std::string Bounds::problem() const {
  if (!is_half_line(*this)) return "is out of range";
  return with_low ? "is negative" : "is not positive";
}

std::string Bounds::remedy() const {
  const auto above = fmt::format("give a number {} {}", with_low ? ">=" : ">", low);
  return is_half_line(*this) ? above : above + fmt::format(" and {} {}", with_high ? "<=" : "<", high);
}

std::optional<UnitSlip> unit_slip(const Quantity& quantity, double value) {
  for (const auto& other : quantity.others)
    if (std::abs(value) >= other.low && std::abs(value) <= other.high)
      return UnitSlip{other.name, value * other.factor};
  return std::nullopt;
}

// The limits are those of blood and tissue: density 0.7 to 1.5 mg/mm^3 (wall 2), viscosity 2e-3 to 6e-3 kPa ms,
// pressure up to 50 kPa, stiffness 100 to 10,000 kPa, bulk modulus to twice that of water. Poise is missing on purpose:
// blood's 0.035 P would be a fluid ten times as viscous, which is merely unusual.
namespace quantity {

const Quantity& number() {
  static const Quantity q{"", {}};
  return q;
}

const Quantity& density() {
  static const Quantity q{"mg/mm^3", {}};
  return q;
}

const Quantity& fluid_density() {
  static const Quantity q{"mg/mm^3",
                          {{"kg/m^3", 1e-3, 700, 1500},
                           {"g/mm^3", 1e3, 0.95e-3, 1.1e-3},  // air is 1.2e-3 mg/mm^3
                           {"kg/mm^3", 1e6, 0.7e-6, 1.5e-6},
                           {"t/mm^3", 1e9, 0.7e-9, 1.5e-9}}};
  return q;
}

const Quantity& wall_density() {
  static const Quantity q{"mg/mm^3",
                          {{"kg/m^3", 1e-3, 700, 2000}, {"kg/mm^3", 1e6, 0.7e-6, 2e-6}, {"t/mm^3", 1e9, 0.7e-9, 2e-9}}};
  return q;
}

const Quantity& viscosity() {
  static const Quantity q{"kPa ms", {{"mPa s (centipoise)", 1e-3, 2, 6}, {"kPa s", 1e3, 2e-6, 6e-6}}};
  return q;
}

const Quantity& wall_viscosity() {
  static const Quantity q{"kPa ms", {}};
  return q;
}

const Quantity& pressure() {
  static const Quantity q{
      "kPa", {{"mmHg", 0.133322, 60, 300}, {"Pa", 1e-3, 300, 5e4}, {"dyn/cm^2", 1e-4, 5e4, 5e5}}, true};
  return q;
}

const Quantity& stiffness() {
  static const Quantity q{"kPa", {{"Pa", 1e-3, 1e5, 1e7}}};
  return q;
}

const Quantity& bulk_modulus() {
  static const Quantity q{"kPa", {{"Pa", 1e-3, 2e7, 9e8}, {"Pa", 1e-3, 1.5e9, 5e9}}};
  return q;
}

const Quantity& time() {
  static const Quantity q{"ms", {{"s", 1e3, 1e-5, 1e-3}}};
  return q;
}

const Quantity& rate() {
  static const Quantity q{"1/ms", {}};
  return q;
}

const Quantity& bedding() {
  static const Quantity q{"kPa/mm", {}};
  return q;
}

const Quantity& bedding_damping() {
  static const Quantity q{"kPa ms/mm", {}};
  return q;
}

const Quantity& length() {
  static const Quantity q{"mm", {}};
  return q;
}

const Quantity& angle() {
  static const Quantity q{"degrees", {{"radians", 57.29577951308232, 0.01, 1.5708}}};
  return q;
}

const Quantity& flow_rate() {
  static const Quantity q{"mm^3/ms", {}};  // 1 mm^3/ms is 1 ml/s: the usual unit for blood
  return q;
}

const Quantity& resistance() {
  static const Quantity q{"kPa ms/mm^3", {{"dyn s/cm^5", 1e-4, 1e4, 1e7}, {"Pa s/m^3", 1e-9, 1e7, 1e12}}};
  return q;
}

const Quantity& compliance() {
  static const Quantity q{"mm^3/kPa", {{"m^3/Pa", 1e12, 1e-13, 1e-7}}};
  return q;
}

}  // namespace quantity

}  // namespace fsi
