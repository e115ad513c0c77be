#pragma once

#include <memory>

#include "partitioned/coupling_stepper.hpp"
#include "partitioned/interface/robin_neumann.hpp"

namespace fsi {

/// Dirichlet-Neumann iterations: the fluid has its velocity prescribed on the wall, the wall the fluid's traction.
/// Something other than the wall must determine the fluid's pressure.
template <int n>
class DirichletNeumannStepper : public CouplingStepper<n> {
 public:
  /// \throws InputError where nothing determines the fluid's pressure
  DirichletNeumannStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme);
};

/// Robin-Neumann iterations, whose condition takes the wall for a tube around the fluid.
template <int n>
class RobinNeumannStepper : public CouplingStepper<n> {
 public:
  /// Notes where the wall is no such tube, and where steps are too long for it.
  RobinNeumannStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme);

 protected:
  /// With another problem of the kind.
  RobinNeumannStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme,
                      std::unique_ptr<RobinNeumann<n>> problem);
};

}  // namespace fsi
