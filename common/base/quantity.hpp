#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace fsi {

/// An interval of numbers that a key takes; its ends belong to it or not.
struct Bounds {
  double low, high;
  bool with_low, with_high;

  bool contains(double x) const { return (with_low ? x >= low : x > low) && (with_high ? x <= high : x < high); }
  std::string problem() const;  ///< with a number outside: "is not positive", "is negative" or "is out of range"
  std::string remedy() const;   ///< "give a number > 0"
};
inline constexpr Bounds positive{0, std::numeric_limits<double>::infinity(), false, false};
inline constexpr Bounds not_negative{0, std::numeric_limits<double>::infinity(), true, false};
inline constexpr Bounds any_number{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                                   false, false};

/// A unit that users mistake for the right one, and the values that give it away. Such values would be absurd in the
/// right unit, not merely unusual: nobody computes with a fluid a thousand times denser than water.
struct OtherUnit {
  const char* name;
  double factor;     ///< a value in this unit times `factor` is one in the right unit
  double low, high;  ///< values that are in this unit, both ends included
};

/// A kind of number with a unit.
struct Quantity {
  const char* unit;  ///< empty: a pure number
  std::vector<OtherUnit> others;
  bool borne_by_wall = false;  ///< a load: the wall's stiffness tells whether a value may be meant as it stands
};

/// A value in the wrong unit.
struct UnitSlip {
  const char* unit;  ///< that the value seems to be in
  double meant;      ///< the value in the right unit
};
/// The unit that a value seems to be in; empty when it may be meant as it stands. The sign does not matter.
std::optional<UnitSlip> unit_slip(const Quantity& quantity, double value);

/// What the keys of a case file measure. The units are mm, ms and mg, hence kPa (docs/theory.md, section 1.1).
namespace quantity {
const Quantity& number();
const Quantity& density();  ///< without other units: no value gives a wrong one away
const Quantity& fluid_density();
const Quantity& wall_density();
const Quantity& viscosity();
const Quantity& wall_viscosity();  ///< a thousand to a million times that of blood: no value gives a wrong unit away
const Quantity& pressure();
const Quantity& stiffness();
const Quantity& bulk_modulus();
const Quantity& time();
const Quantity& rate();     ///< 1/ms
const Quantity& bedding();  ///< stiffness of springs per area
const Quantity& bedding_damping();
const Quantity& length();
const Quantity& angle();
const Quantity& flow_rate();   ///< mm^3/ms
const Quantity& resistance();  ///< kPa ms/mm^3
const Quantity& compliance();  ///< mm^3/kPa
}  // namespace quantity

}  // namespace fsi
