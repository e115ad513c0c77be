#pragma once

#include <vector>

namespace fsi {

/// An operator on chosen nodes of the fluid, beside the equations of the scene: c (u - v) joins their momentum rows in
/// the residual of a System, and c its Jacobian's diagonal. The fluid's own rows do not hold it.
struct InterfaceImpedance {
  std::vector<int> nodes;         ///< of the fluid
  std::vector<double> impedance;  ///< c per node, kPa mm^2 / (mm/ms): any numbers, zero and negative ones too
  std::vector<double> velocity;   ///< v, n numbers per node, mm/ms
  /// v is at each residual the one with which these rows vanish, and `velocity` is not read: what the fluid's own rows
  /// lack is then another system's to balance.
  bool balanced = false;
};

}  // namespace fsi
