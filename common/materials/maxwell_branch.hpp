#pragma once

namespace fsi {

/// A spring and a dashpot one after the other, beside the elastic law of a layer (docs/theory.md, section 5.11).
struct MaxwellBranch {
  double shear = 0;  ///< G, modulus of the spring, kPa
  double time = 0;   ///< tau, in which its stress relaxes, ms: the dashpot has the viscosity G tau in shear
};

}  // namespace fsi
