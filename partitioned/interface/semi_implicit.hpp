#pragma once

#include <vector>

#include "partitioned/interface/robin_neumann.hpp"

namespace fsi {

/// Semi-implicit coupling ([Fernandez2007]; docs/theory.md, section 10.7): velocity, pressure and wall agree at the end
/// of a step, as in RobinNeumann, on a domain of the fluid that is extrapolated before,
///   d_m = d* on the interface, d* = the wall's displacement extrapolated in time.
/// No pass moves the mesh, and the fluid's Jacobian has no shape derivatives. Velocities of the mesh are differences of
/// d*.
template <int n>
class SemiImplicit : public RobinNeumann<n> {
  using Base = RobinNeumann<n>;

 public:
  SemiImplicit(Scene<n>& scene, const PartitionedData& options)
      : Base(scene, options, number_fluid(scene, /*free_interface=*/true)) {}

  void start(State& state, StepData& data) override {
    Base::start(state, data);
    Base::move_mesh(Base::wall_displacement(state.now));
  }
  bool domain_follows() const override { return false; }
};

}  // namespace fsi
