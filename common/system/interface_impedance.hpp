#pragma once

#include <vector>

namespace fsi {

/// An operator on chosen nodes of one medium, beside the equations of the scene: c (u - v) joins their momentum rows in
/// the residual of a MediumSystem, and c its Jacobian's diagonal. The medium's own rows do not hold it. u is the fluid's
/// velocity, or the wall's, u - v = (d - x) / period with the datum v given as a displacement x.
struct InterfaceImpedance {
  enum class Medium { fluid, wall };

  std::vector<int> nodes;         ///< of the medium
  std::vector<double> impedance;  ///< c per node, kPa mm^2 / (mm/ms): any numbers, zero and negative ones too
  std::vector<double> velocity;   ///< v, n numbers per node, mm/ms
  /// v is at each residual the one with which these rows vanish, and `velocity` is not read: another system balances the
  /// residual of the fluid's own rows.
  bool balanced = false;
  Medium medium = Medium::fluid;     ///< not `balanced` of the wall
  std::vector<double> displacement;  ///< x of the wall, n numbers per node, mm; `velocity` is not read there
};

}  // namespace fsi
