#pragma once

#include <vector>

namespace fsi {

/// An impedance at chosen nodes of one medium: c (u - v) is added to their momentum rows in the residual of a
/// MediumSystem, and c to its Jacobian's diagonal, but not to the medium's own rows. u is the fluid's velocity, or the
/// wall's, u - v = (d - x) / period with the datum v given as a displacement x.
struct InterfaceImpedance {
  enum class Medium { fluid, wall };

  std::vector<int> nodes;         ///< of the medium
  std::vector<double> impedance;  ///< c per node, kPa mm^2 / (mm/ms): any numbers, zero and negative ones too
  std::vector<double> velocity;   ///< v, n numbers per node, mm/ms
  /// These rows are set to zero, and `velocity` is not read: another system balances the fluid's own rows.
  bool balanced = false;
  Medium medium = Medium::fluid;     ///< the wall's cannot be `balanced`
  std::vector<double> displacement;  ///< x of the wall, n numbers per node, mm; `velocity` is not read there
};

}  // namespace fsi
