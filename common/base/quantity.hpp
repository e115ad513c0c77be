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
  std::string problem() const;  ///< of a number outside: "is not positive", "is negative" or "is out of range"
  std::string remedy() const;   ///< "give a number > 0"
};
inline constexpr Bounds positive{0, std::numeric_limits<double>::infinity(), false, false};
inline constexpr Bounds not_negative{0, std::numeric_limits<double>::infinity(), true, false};
inline constexpr Bounds any_number{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                                   false, false};

/// A unit that users mistake for the right one, and the values that give it away. They lie where a value in the right
/// unit would be beyond what is merely unusual: nobody computes with a fluid a thousand times denser than water.
struct OtherUnit {
  const char* name;
  double factor;     ///< a value in this unit times `factor` is one in the right unit
  double low, high;  ///< values that are in this unit, both ends included
};

/// A kind of number with a unit.
struct Quantity {
  const char* unit;  ///< empty: a pure number
  std::vector<OtherUnit> others;
  bool borne_by_wall = false;  ///< what a wall bears: its stiffness tells whether a value may be meant as it stands
};

/// A value in the wrong unit.
struct UnitSlip {
  const char* unit;  ///< that the value seems to be in
  double meant;      ///< the value in the right unit
};
/// Empty when the value may be what it says. The sign does not matter.
std::optional<UnitSlip> unit_slip(const Quantity& quantity, double value);

/// What the keys of a case file measure. The system of units is mm, ms, mg, and kPa with it.
namespace quantity {
const Quantity& number();
const Quantity& density();  ///< of anything: nothing gives a wrong unit away
const Quantity& fluid_density();
const Quantity& wall_density();
const Quantity& viscosity();
const Quantity& pressure();
const Quantity& stiffness();
const Quantity& bulk_modulus();
const Quantity& time();
const Quantity& rate();     ///< 1/ms
const Quantity& bedding();  ///< of a spring per area
const Quantity& bedding_damping();
const Quantity& length();
const Quantity& angle();
const Quantity& flow_rate();   ///< mm^3/ms
const Quantity& resistance();  ///< kPa ms/mm^3
const Quantity& compliance();  ///< mm^3/kPa
}  // namespace quantity

}  // namespace fsi
