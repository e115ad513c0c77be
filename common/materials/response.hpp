#pragma once

#include "materials/strain.hpp"

namespace fsi {

/// The response of a wall's material to a deformation in the mixed form (docs/theory.md, section 4.1): with a measure g
/// of the change of volume and G = dg/dF the first Piola-Kirchhoff stress is P = P' - p G, p = -K g.
template <class T>
struct Response {
  Mat3<T> flux;             ///< P' = dPsi'/dF, kPa
  T volume_measure;         ///< g
  Mat3<T> volume_gradient;  ///< G
  T volume_ratio;           ///< of the configuration in which forces balance; must be positive
};

}  // namespace fsi
