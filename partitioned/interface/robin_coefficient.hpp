#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "case/case.hpp"
#include "partitioned/interface/membrane.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// alpha of the loosely coupled Robin-Robin schemes, and why it is this one.
struct RobinCoefficient {
  double value;        ///< kPa/(mm/ms)
  std::string reason;  ///< a clause for the log
};

/// As the case gives it; else, K being the hoop stiffness of the wall and R the radius that volume and surface of the fluid
/// give,
///   alpha = sqrt(K (rho_s h + rho_f R / 2)),
/// traction over velocity in an oscillation of the ring with the fluid's added mass. The wall is off by an apparent mass
/// alpha dt per area, which grows with alpha, and fluid and wall differ in velocity by dt lambda' / alpha, which falls: the
/// two are alike where alpha is the size of lambda / w (docs/coupling.md). It does not depend on the step.
template <int n>
RobinCoefficient robin_coefficient(const PartitionedData& options, const Scene<n>& scene, const Membrane& membrane) {
  if (options.robin_coefficient) return {*options.robin_coefficient, "named by the case"};
  const double wall = membrane.density * membrane.thickness;
  const double fluid = scene.fluid->form().density * membrane.radius / 2;
  return {std::sqrt(membrane.stiffness() * (wall + fluid)),
          fmt::format("hoop stiffness {:.3g} kPa/mm, mass of the wall {:.3g} and of the fluid {:.3g} mg/mm^2",
                      membrane.stiffness(), wall, fluid)};
}

}  // namespace fsi
