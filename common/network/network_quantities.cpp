#include "network/network_quantities.hpp"

namespace fsi::quantity {

// No usual range: some animal's vessel or heart has any value, so that none reveals a wrong unit.

const Quantity& inertance() {
  static const Quantity q{"kPa ms^2/mm^3", {}};
  return q;
}

const Quantity& elastance() {
  static const Quantity q{"kPa/mm^3", {}};
  return q;
}

const Quantity& quadratic_resistance() {
  static const Quantity q{"kPa ms^2/mm^6", {}};
  return q;
}

const Quantity& volume() {
  static const Quantity q{"mm^3", {}};
  return q;
}

}  // namespace fsi::quantity
