#pragma once

#include <array>
#include <string>

namespace fsi {

/// A row of surfaces.csv: what the fluid does to a surface at a time; in plane scenes per mm of thickness.
struct SurfaceRecord {
  std::string surface;
  double area = 0;                   ///< mm^2
  std::array<double, 3> force{};     ///< mN = kPa mm^2
  std::array<double, 3> pressure{};  ///< mN, the pressure's part of the force
};

}  // namespace fsi
