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

/// As the case gives it; else, with the wall's hoop stiffness K and the radius R (Membrane),
///   alpha = sqrt(K (rho_s h + rho_f R / 2)),
/// traction over velocity in an oscillation of the ring with the fluid's added mass (docs/theory.md, section 10.5). It
/// does not depend on the step. Two errors balance: the apparent mass alpha dt per area of the wall grows with alpha,
/// and the velocity difference dt lambda' / alpha of fluid and wall falls. They are of one size where alpha is about
/// the ratio of the traction lambda to the wall's velocity (docs/coupling.md).
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
