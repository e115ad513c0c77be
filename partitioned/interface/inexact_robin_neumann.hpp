#pragma once

#include <vector>

#include "partitioned/interface/robin_neumann.hpp"
#include "partitioned/medium_solvers.hpp"
#include "partitioned/scheme_choice.hpp"

namespace fsi {

/// Robin-Neumann whose passes cost about one linear solve and one residual of each medium (docs/theory.md, section
/// 10.2a).
/// - Each medium continues from the fields and the residual of the last pass; only datum and load are new.
/// - The wall's load follows from the Robin condition, lambda~ = g - c u. The fluid's momentum rows would add the
///   residual that the inexact solve leaves.
/// - The coefficient is the wall's impedance in normal direction, z_n (Membrane::normal_impedance()). Where passes
///   stagnate the stage begins anew with that of RobinNeumann.
/// - The first guess is the wall's response to the extrapolated load, not the extrapolated displacement: an error e of
///   the displacement is a rho_f R e / 2 as a pressure, 1/a being the square of the step; an error of the load is not
///   amplified.
template <int n>
class InexactRobinNeumann : public RobinNeumann<n> {
  using Base = RobinNeumann<n>;
  using Base::state_, Base::data_, Base::scene_, Base::membrane_, Base::fluid_, Base::wall_, Base::robin_;

 public:
  InexactRobinNeumann(Scene<n>& scene, const PartitionedData& options)
      : InexactRobinNeumann(scene, medium_solvers(scene, options)) {}

  void start(State& state, StepData& data) override {
    Base::start(state, data);
    keeps_rows_ = false;
    if (!wall_decides_ || wall_.linearised()) return;
    wall_.evaluate();  // the first Jacobian is the wall's, by which the fluid's solver is chosen
    wall_.linearise();
  }

  std::vector<double> first_guess(int order) override {
    const std::vector<double> load = Base::extrapolated_load(order);
    if (order > 0 && state_->step > 0) {
      put_load(load);
      const std::vector<double> extrapolated = state_->now.wall;
      try {
        Base::solve_loaded_wall(of_first_guess);
      } catch (const PassFailure&) {  // a guess need not be the best one
        state_->now.wall = extrapolated;
      }
    }
    return Base::datum(Base::wall_displacement(state_->now), load);
  }

  /// Where the wall is light beside the fluid, z_n is far from the impedance of most modes.
  bool change_coefficient() override {
    if (changed_) return false;
    changed_ = true;
    fluid_.forget_jacobian();
    scene_.profile.count("changed Robin conditions");
    return true;
  }

  void keep(RestartArchive& archive) override {
    double changed = changed_ ? 1 : 0;
    archive.number_if_there("changed_coefficient", changed);
    changed_ = changed != 0;
    Base::keep(archive);
  }

  Pass pass(const std::vector<double>& x, const PassAccuracy& accuracy) override {
    if (keeps_rows_)
      Base::set_datum(x);
    else
      Base::begin_pass(x);
    return refine(accuracy);
  }

  Pass refine(const PassAccuracy& accuracy) override {
    if (keeps_rows_) {
      fluid_.keep_rows();
      wall_.keep_rows();
    }
    keeps_rows_ = false;  // where the pass throws, the stepper resets the fields and the kept residuals do not match
    Pass pass = Base::refine(accuracy);
    keeps_rows_ = true;
    return pass;
  }

 protected:
  double coefficient(const StepRates& rates) const override {
    if (changed_) return Base::coefficient(rates);
    return membrane_.normal_impedance(rates.acceleration_factor, rates.interface.period);
  }

  void answer_of_wall(const PassAccuracy& accuracy) override {
    std::vector<double> load(Base::interface_size());
    for (std::size_t i = 0; i < load.size(); ++i) {
      const double u = state_->now.fluid[Base::fluid_entry(scene_.interface[i / n], static_cast<int>(i % n))];
      load[i] = robin_.impedance[i / n] * (robin_.velocity[i] - u);
    }
    put_load(load);
    Base::solve_loaded_wall(accuracy);
  }

 private:
  static constexpr PassAccuracy of_first_guess{0, false, 3, 0.01};

  InexactRobinNeumann(Scene<n>& scene, const MediumSolvers<n>& solvers)
      : Base(scene, number_fluid_and_domain(scene), solvers), wall_decides_(solvers.wall_decides) {}

  void put_load(const std::vector<double>& load) {
    data_->interface_load.assign(state_->now.wall.size(), 0.0);
    for (std::size_t i = 0; i < load.size(); ++i)
      data_->interface_load[Base::wall_entry(scene_.interface[i / n], static_cast<int>(i % n))] = load[i];
  }

  bool wall_decides_;
  bool changed_ = false;     ///< the coefficient is another one than z_n
  bool keeps_rows_ = false;  ///< fields and residuals of the media are those of the last pass
};

}  // namespace fsi
