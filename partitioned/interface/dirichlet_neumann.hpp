#pragma once

#include <vector>

#include "algebra/vector_operations.hpp"
#include "partitioned/interface/coupling_pass.hpp"

namespace fsi {

/// Dirichlet-Neumann (docs/theory.md, section 10.1), x = d: mesh motion from the interface displacement d; fluid with
/// u = (d - reference) / period on the interface (InterfaceKinematics; backward Euler: (d - d^(n-1)) / dt); the fluid's
/// interface residual as load on the wall, whose displacement is d~; r = d~ - d.
template <int n>
class DirichletNeumann : public CouplingPass<n> {
  using Base = CouplingPass<n>;
  using Base::cost, Base::scene_, Base::state_, Base::data_;

 public:
  DirichletNeumann(Scene<n>& scene, const PartitionedData& options)
      : Base(scene, options), fluid_("fluid", scene, number_fluid(scene), Base::solver_factory(options)) {}

  const System<n>& fluid() const override { return fluid_; }

  void start(State& state, StepData& data) override {
    Base::start(state, data);
    fluid_.work_on(state, data);
  }

  std::vector<double> first_guess(int) override { return Base::wall_displacement(state_->now); }

  Pass pass(const std::vector<double>& d, const PassAccuracy& accuracy) override {
    d_ = d;
    Base::move_mesh(d);
    const StepRates& rates = data_->rates;
    for (std::size_t i = 0; i < scene_.interface.size(); ++i)
      for (int k = 0; k < n; ++k) {
        const auto& node = scene_.interface[i];
        // The velocity of the mesh, so that no fluid crosses the interface, whatever gap the last step left. But where
        // carry < 1, values at the end of a stage are extrapolated from its balance. That gap would then alternate in
        // sign from step to step, so the reference is the wall's.
        const double reference = rates.carry < 1 ? rates.wall_reference[Base::wall_entry(node, k)]
                                                 : rates.mesh_reference[Base::mesh_entry(node, k)];
        state_->now.fluid[Base::fluid_entry(node, k)] = rates.interface.velocity(d[i * n + k], reference);
      }
    return refine(accuracy);
  }

  Pass refine(const PassAccuracy& accuracy) override {
    {
      const Stopwatch watch(cost.fluid_seconds);
      Base::solve_medium("fluid", fluid_, accuracy, {}, cost.fluid_newton, cost.fluid_linear);
    }
    Base::solve_wall(fluid_.fluid_residual(), accuracy);
    Pass pass;
    pass.displacement = Base::wall_displacement(state_->now);
    pass.residual = pass.displacement;
    axpy(-1, d_, pass.residual);
    return pass;
  }

  void keep(RestartArchive& archive) override {
    Base::keep(archive);
    keep_linearisation("fluid", fluid_, archive);
  }

 private:
  MediumSystem<n> fluid_;
  std::vector<double> d_;
};

}  // namespace fsi
