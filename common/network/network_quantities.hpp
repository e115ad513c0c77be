#pragma once

#include "base/quantity.hpp"

namespace fsi::quantity {

// What lumped elements measure beside resistance and compliance.
const Quantity& inertance();             ///< kPa ms^2/mm^3
const Quantity& elastance();             ///< kPa/mm^3
const Quantity& quadratic_resistance();  ///< kPa ms^2/mm^6
const Quantity& volume();                ///< mm^3

}  // namespace fsi::quantity
