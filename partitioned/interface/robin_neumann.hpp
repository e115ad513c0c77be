#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "algebra/vector_operations.hpp"
#include "partitioned/interface/coupling_pass.hpp"
#include "partitioned/interface/membrane.hpp"
#include "partitioned/medium_solvers.hpp"
#include "time/predictor.hpp"

namespace fsi {

/// Robin-Neumann ([Badia2008]; docs/theory.md, section 10.2), the condition on all components: the fluid solves
///   R_f + c u = g on the interface,   g = lambda + c v,
/// with load lambda and velocity v of the wall from the last pass; the wall is loaded with lambda~ = R_f. With
/// c = alpha times the nodal areas, alpha being the wall's own impedance (membrane.hpp), the fluid meets the inertia
/// and stiffness of the wall, and the added mass does no harm. The datum g is written as a displacement,
/// x = reference + period g / c (InterfaceKinematics). The next datum is then x~ = x + (d~ - d_f), d_f being the
/// displacement that the fluid gave the interface: r = d~ - d_f.
template <int n>
class RobinNeumann : public CouplingPass<n> {
  using Base = CouplingPass<n>;

 protected:
  using Base::cost, Base::scene_, Base::membrane_, Base::state_, Base::data_, Base::wall_;

 public:
  RobinNeumann(Scene<n>& scene, const PartitionedData& options)
      : RobinNeumann(scene, options, number_fluid_and_domain(scene)) {}

 protected:
  /// \param fluid  unknowns of the fluid, its velocity free on the interface
  RobinNeumann(Scene<n>& scene, const PartitionedData& options, Numbering fluid)
      : RobinNeumann(scene, std::move(fluid), {Base::solver_factory(options), Base::solver_factory(options)}) {}
  RobinNeumann(Scene<n>& scene, Numbering fluid, const MediumSolvers<n>& solvers)
      : Base(scene, solvers.wall),
        fluid_("fluid", scene, std::move(fluid), solvers.fluid, SystemNorm::entries, &robin_) {
    for (const auto& node : scene.interface) robin_.nodes.push_back(node.fluid);
    robin_.velocity.assign(Base::interface_size(), 0.0);
    for (auto& load : loads_) load.assign(Base::interface_size(), 0.0);
  }

 public:
  const System<n>& fluid() const override { return fluid_; }

  void start(State& state, StepData& data) override {
    Base::start(state, data);
    if (data.rates.stage == 0) stage_loads_.clear();  // left by a step that failed or was rejected
    robin_.impedance = impedance_of(data.rates);
    fluid_.work_on(state, data);
  }

  /// The extrapolated displacement, and the load extrapolated alike.
  std::vector<double> first_guess(int order) override {
    return datum(Base::wall_displacement(state_->now), extrapolated_load(order));
  }

  Pass pass(const std::vector<double>& x, const PassAccuracy& accuracy) override {
    begin_pass(x);
    return refine(accuracy);
  }

  Pass refine(const PassAccuracy& accuracy) override {
    {
      const Stopwatch watch(cost.fluid_seconds);
      Base::solve_medium("fluid", fluid_, accuracy, {}, cost.fluid_newton, cost.fluid_linear);
    }
    answer_of_wall(accuracy);
    Pass pass;
    pass.displacement = Base::wall_displacement(state_->now);
    pass.residual = pass.displacement;
    for (std::size_t i = 0; i < scene_.interface.size(); ++i)
      for (int k = 0; k < n; ++k) pass.residual[i * n + k] -= Base::displacement_of_fluid(scene_.interface[i], k);
    return pass;
  }

  bool stiffen() override {
    if (stiffening_ >= most_stiffening) return false;
    stiffening_ *= stiffening_factor;
    return true;
  }

  void accept() override {
    stage_loads_.emplace_back(Base::interface_size());
    const std::vector<double>* rows = &fluid_.fluid_residual();
    if (const auto& share = scene_.fluid->nodes().share) {  // rows of ghosts are not whole here
      whole_rows_ = *rows;
      share->template update<MixedLayout<n>>(whole_rows_);
      rows = &whole_rows_;
    }
    for (std::size_t i = 0; i < scene_.interface.size(); ++i)
      for (int k = 0; k < n; ++k) stage_loads_.back()[i * n + k] = (*rows)[Base::fluid_entry(scene_.interface[i], k)];
  }
  void finish_step() override {
    for (auto& load : stage_loads_) {
      std::swap(loads_[2], loads_[1]);
      std::swap(loads_[1], loads_[0]);
      loads_[0] = std::move(load);
    }
    stage_loads_.clear();
  }

  void keep(RestartArchive& archive) override {
    Base::keep(archive);
    archive.number_if_there("stiffening", stiffening_);
    keep_linearisation("fluid", fluid_, archive,
                       [this](const StepRates& rates) { robin_.impedance = impedance_of(rates); });
    if (!archive.wants({"load0", "load1", "load2"})) return;
    for (std::size_t level = 0; level < loads_.size(); ++level)
      archive.array("load" + std::to_string(level), ArrayKind::interface, loads_[level]);
  }

 protected:
  /// The load lambda of the interface, extrapolated in time by `order` (0 to 2): n numbers per interface node, kPa
  /// mm^2.
  std::vector<double> extrapolated_load(int order) const {
    const auto weights = scene_.integrator->balance_weights(*state_, order, *data_);
    std::vector<double> load(Base::interface_size(), 0.0);
    for (std::size_t level = 0; level < 3; ++level) axpy(weights[level], load_before(level), load);
    return load;
  }
  /// The datum of a displacement and a load of the wall: d + period lambda / c, mm. Held components stay d.
  /// \param x     d, n numbers per interface node, mm
  /// \param load  lambda, likewise, kPa mm^2
  std::vector<double> datum(std::vector<double> x, const std::vector<double>& load) const {
    for (std::size_t i = 0; i < scene_.interface.size(); ++i) {
      if (robin_.impedance[i] == 0) continue;
      const auto& node = scene_.interface[i];
      const auto* axes = scene_.fluid_frames.at(node.fluid);  // in which some components are free, and others held
      Direction<n> further{};
      for (int k = 0; k < n; ++k) further[k] = load[i * n + k];
      if (axes) NodalFrames<n>::to_frame(*axes, further.data());
      for (int k = 0; k < n; ++k) {
        const bool held = fluid_.numbering().fluid[Base::fluid_entry(node, k)].index < 0;
        further[k] = held ? 0 : data_->rates.interface.displacement(further[k] / robin_.impedance[i], 0.0);
      }
      if (axes) NodalFrames<n>::to_space(*axes, further.data());
      for (int k = 0; k < n; ++k) x[i * n + k] += further[k];
    }
    return x;
  }

  /// alpha, kPa/(mm/ms).
  virtual double coefficient(const StepRates& rates) const {
    return membrane_.impedance(rates.acceleration_factor, rates.interface.period);
  }

  /// Solves the wall, loaded with the fluid's momentum rows.
  virtual void answer_of_wall(const PassAccuracy& accuracy) { Base::solve_wall(fluid_.fluid_residual(), accuracy); }

  void set_datum(const std::vector<double>& x) {
    for (std::size_t i = 0; i < x.size(); ++i)
      robin_.velocity[i] = data_->rates.interface.velocity(
          x[i], data_->rates.wall_reference[Base::wall_entry(scene_.interface[i / n], static_cast<int>(i % n))]);
  }
  void begin_pass(const std::vector<double>& x) {
    set_datum(x);
    if (this->domain_follows()) follow_fluid(*state_);
  }

  InterfaceImpedance robin_;  ///< R_f + c (u - v), v being g / c
  MediumSystem<n> fluid_;

 private:
  /// Where elements are small the membrane's impedance may let the interface move so far in the first pass that they
  /// are inverted. Four times the impedance costs few passes, if any: 6 to 11 a step on a graded quarter of the artery,
  /// where the first pass fails with the impedance itself.
  static constexpr double stiffening_factor = 4, most_stiffening = 64;

  std::vector<double> impedance_of(const StepRates& rates) const {
    std::vector<double> impedance = membrane_.node_areas;
    scale(stiffening_ * coefficient(rates), impedance);
    return impedance;
  }

  /// lambda of the last solutions of the equations, those of the step in progress among them, the latest first.
  const std::vector<double>& load_before(std::size_t level) const {
    const std::size_t stages = stage_loads_.size();
    return level < stages ? stage_loads_[stages - 1 - level] : loads_[level - stages];
  }

  /// Sets the mesh on the interface to what the fluid's velocity there gives, so that the result of the pass is a
  /// function of the datum alone. The increments of Newton's method keep this relation, and move the mesh inside.
  void follow_fluid(State& state) {
    for (const auto& node : scene_.interface)
      for (int k = 0; k < n; ++k)
        state.now.mesh[Base::mesh_entry(node, k)] = data_->rates.interface.displacement(
            state.now.fluid[Base::fluid_entry(node, k)], data_->rates.wall_reference[Base::wall_entry(node, k)]);
  }

  double stiffening_ = 1;                         ///< factor of the coefficient
  std::vector<double> whole_rows_;                ///< the fluid's, ghosts too
  std::array<std::vector<double>, 3> loads_;      ///< lambda of the last stages of finished steps, the latest first
  std::vector<std::vector<double>> stage_loads_;  ///< lambda of the stages of the step in progress
};

}  // namespace fsi
