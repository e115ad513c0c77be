#include "network/network_quantities.hpp"

namespace fsi::quantity {

// Any size of them is a vessel's or a heart's of some animal: no value gives a wrong unit away.

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
