#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "algebra/vector_operations.hpp"
#include "partitioned/interface/coupling_pass.hpp"
#include "partitioned/interface/robin_coefficient.hpp"

namespace fsi {

/// Data of the Robin conditions on both sides of the interface. A base class, so that they exist before the other base,
/// CouplingPass, whose wall refers to them.
struct RobinSides {
  InterfaceImpedance wall_side_{}, fluid_side_{};
};

/// The loosely coupled Robin-Robin scheme ([Burman2023]; docs/theory.md, section 10.5). A step is one wall and then one
/// fluid solve, c being nodal areas times the coefficient alpha, F and W the momentum rows of fluid and wall on the
/// interface, u the fluid's velocity there, w the wall's, and lambda^n = F^n of the last step:
///   W^(n+1) + lambda^n + c (w^(n+1) - u^n) = 0,
///   F^(n+1) - lambda^n + c (u^(n+1) - w^(n+1)) = 0.
/// The fluid's domain follows the wall. alpha does not depend on the step: the gap c (u - w) = lambda^n - lambda^(n+1)
/// is of first order then, and telescopes, so that the displacements do not drift apart. x is not used, and
///   r = period (w - u).
/// Where a step is iterated, x is the datum v of the wall's condition, given as a displacement. A pass and its next
/// datum:
///   W + c (w - v) = 0,   L = c (w - v),   F - L + c (u - w) = 0,   v~ = u - F/c,
///   r = period (v~ - v) = 2 period (u - w).
template <int n>
class RobinRobin : private RobinSides, public CouplingPass<n> {
  using Base = CouplingPass<n>;

 public:
  using Base::cost;

  /// \param factor  alpha over the coefficient of the case, or of the scene
  RobinRobin(Scene<n>& scene, const PartitionedData& options, double factor = 1)
      : Base(scene, options, &wall_side_),
        coefficient_(robin_coefficient(options, scene, Base::membrane_)),
        alpha_(factor * coefficient_.value),
        fluid_("fluid", scene, number_fluid(scene, /*free_interface=*/true), Base::solver_factory(options),
               SystemNorm::entries, &fluid_side_) {
    wall_side_.medium = InterfaceImpedance::Medium::wall;
    for (const auto& node : scene.interface) {
      fluid_side_.nodes.push_back(node.fluid);
      wall_side_.nodes.push_back(node.wall);
    }
    fluid_side_.impedance = Base::membrane_.node_areas;
    scale(alpha_, fluid_side_.impedance);
    wall_side_.impedance = fluid_side_.impedance;
    for (auto* numbers : {&fluid_side_.velocity, &wall_side_.displacement, &traction_, &next_traction_, &load_})
      numbers->assign(Base::interface_size(), 0.0);
  }

  const RobinCoefficient& coefficient() const { return coefficient_; }

  const System<n>& fluid() const override { return fluid_; }

  void start(State& state, StepData& data) override {
    Base::start(state, data);
    fluid_.work_on(state, data);
    if (data.rates.stage == 0) changes_.clear();
    if (known_) return;
    known_ = true;
    if (state.step > 0 || scene_.initial_load) find_data(state, data);
  }

  void iterate(bool on) override { iterates_ = on; }

  std::vector<double> first_guess(int) override {
    std::vector<double> x = Base::wall_displacement(state_->now);
    if (!iterates_) return x;
    const std::vector<double> w = velocity_of_wall(x);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (const double c = wall_side_.impedance[i / n]; c > 0)
        x[i] = data_->rates.interface.displacement(w[i] - traction_[i] / c, reference(i));
    return x;
  }

  Pass pass(const std::vector<double>& x, const PassAccuracy& accuracy) override {
    datum_ = x;
    return refine(accuracy);
  }
  Pass refine(const PassAccuracy& accuracy) override {
    return iterates_ ? iterated_pass(accuracy) : single_pass(datum_, accuracy);
  }

  /// The mesh is there already.
  void follow_wall() override {}

  void accept() override {
    next_traction_ = last_rows();
    changes_.push_back({velocity_of_fluid(state_->now), next_traction_});
    axpy(-1, last_velocity(), changes_.back().velocity);
    axpy(-1, traction_, changes_.back().traction);
  }
  void finish_step() override { traction_ = next_traction_; }

  /// Data of both Robin conditions, u and lambda: n numbers per interface node, mm/ms and kPa mm^2.
  struct Data {
    std::vector<double> velocity, traction;
  };
  /// By how much the accepted stages of the step differ from the last step.
  const std::vector<Data>& changes() const { return changes_; }

  /// A gap between u and w goes with a change of the traction by alpha times it within a step: alpha / period, kPa/mm.
  double pressure_per_gap() const override { return alpha_ * data_->rates.interface.rate(); }
  /// Relative to the larger of the tractions of fluid and wall: in the first step the wall may bear nothing yet.
  double pressure_residual(const std::vector<double>& gap) const override {
    return traction_size_ > 0 ? Base::gap_pressure(gap) / traction_size_ : 0.0;
  }
  double traction_gap() const override { return traction_gap_; }

  void keep(RestartArchive& archive) override {
    Base::keep(archive);
    keep_linearisation("fluid", fluid_, archive);
    if (!archive.wants({"robin_traction"})) return;
    archive.array("robin_traction", ArrayKind::interface, traction_);
    known_ = true;
  }

 protected:
  using Base::scene_, Base::state_, Base::data_;

  /// The pass of a step without iteration.
  virtual Pass single_pass(const std::vector<double>& /*x*/, const PassAccuracy& accuracy) {
    return pass_with(last_velocity(), traction_, accuracy);
  }

  /// The wall and then the fluid, with these for u^n and lambda^n.
  Pass pass_with(const std::vector<double>& u, const std::vector<double>& lambda, const PassAccuracy& accuracy) {
    answer_of_wall(u, lambda, accuracy);
    const std::vector<double> d = Base::wall_displacement(state_->now);
    Base::move_mesh(d);
    answer_of_fluid(velocity_of_wall(d), lambda, accuracy);
    return finished_pass(d);
  }

  /// u^n: the fluid's velocity on the interface in the last solution of the equations, n numbers per node, mm/ms.
  std::vector<double> last_velocity() const { return velocity_of_fluid(state_->last_balance()); }

  /// w, of a displacement d of the wall in this step.
  std::vector<double> velocity_of_wall(const std::vector<double>& d) const {
    std::vector<double> w(d.size());
    for (std::size_t i = 0; i < d.size(); ++i) w[i] = data_->rates.interface.velocity(d[i], reference(i));
    return w;
  }

  /// Solves W + lambda + c (w - u) = 0; leaves lambda + c (w - u) as the wall's load.
  void answer_of_wall(const std::vector<double>& u, const std::vector<double>& lambda, const PassAccuracy& accuracy) {
    for (std::size_t i = 0; i < u.size(); ++i) load_[i] = lambda[i] - wall_side_.impedance[i / n] * u[i];
    put_load();
    for (std::size_t i = 0; i < u.size(); ++i) wall_side_.displacement[i] = reference(i);
    Base::solve_loaded_wall(accuracy);
    const std::vector<double> w = velocity_of_wall(Base::wall_displacement(state_->now));
    for (std::size_t i = 0; i < u.size(); ++i) load_[i] += wall_side_.impedance[i / n] * w[i];
    put_load();
  }

  /// Solves F - lambda + c (u - w) = 0.
  void answer_of_fluid(const std::vector<double>& w, const std::vector<double>& lambda, const PassAccuracy& accuracy) {
    const Stopwatch watch(cost.fluid_seconds);
    for (std::size_t i = 0; i < w.size(); ++i) {
      const double c = fluid_side_.impedance[i / n];
      fluid_side_.velocity[i] = w[i] + (c > 0 ? lambda[i] / c : 0);
    }
    solve_sub_problem("fluid", fluid_, accuracy.tolerance, {}, cost.fluid_newton, cost.fluid_linear);
  }

  Pass finished_pass(const std::vector<double>& d) {
    Pass pass;
    pass.displacement = d;
    pass.residual = velocity_of_wall(d);
    axpy(-1, velocity_of_fluid(state_->now), pass.residual);
    scale(data_->rates.interface.period, pass.residual);
    std::vector<double> lack = last_rows();
    traction_size_ = std::max(Base::root_mean_traction(lack), Base::root_mean_traction(load_));
    axpy(-1, load_, lack);
    traction_gap_ = Base::root_mean_traction(lack);
    return pass;
  }

  const std::vector<double>& load() const { return load_; }
  bool iterates() const { return iterates_; }

  /// F of the fluid's last solution on the interface, rows of ghosts included.
  std::vector<double> last_rows() {
    const std::vector<double>* rows = &fluid_.fluid_residual();
    if (const auto& share = scene_.fluid->nodes().share) {
      whole_rows_ = *rows;
      share->template update<MixedLayout<n>>(whole_rows_);
      rows = &whole_rows_;
    }
    std::vector<double> on_interface(Base::interface_size());
    for (std::size_t i = 0; i < scene_.interface.size(); ++i)
      for (int k = 0; k < n; ++k) on_interface[i * n + k] = (*rows)[Base::fluid_entry(scene_.interface[i], k)];
    return on_interface;
  }

  /// Sets the data of the last step where another method made that step, or where it is the state at rest under a load,
  /// from the fluid's momentum rows at the first guess of this step.
  virtual void find_data(State&, StepData&) {
    fluid_.evaluate();
    traction_ = last_rows();
  }

  std::vector<double> traction_;  ///< lambda^n, kPa mm^2

 private:
  Pass iterated_pass(const PassAccuracy& accuracy) {
    const std::vector<double> none(datum_.size(), 0.0);
    answer_of_wall(velocity_of_wall(datum_), none, accuracy);
    const std::vector<double> d = Base::wall_displacement(state_->now);
    Base::move_mesh(d);
    answer_of_fluid(velocity_of_wall(d), load_, accuracy);
    Pass pass = finished_pass(d);
    constexpr double residual_of_gap = -2;
    scale(residual_of_gap, pass.residual);
    pass.gap_part = 1 / residual_of_gap;
    return pass;
  }

  double reference(std::size_t i) const {
    return data_->rates.wall_reference[Base::wall_entry(scene_.interface[i / n], static_cast<int>(i % n))];
  }
  std::vector<double> velocity_of_fluid(const Solution& solution) const {
    std::vector<double> u(Base::interface_size());
    for (std::size_t i = 0; i < scene_.interface.size(); ++i)
      for (int k = 0; k < n; ++k) u[i * n + k] = solution.fluid[Base::fluid_entry(scene_.interface[i], k)];
    return u;
  }
  void put_load() {
    data_->interface_load.assign(state_->now.wall.size(), 0.0);
    for (std::size_t i = 0; i < load_.size(); ++i)
      data_->interface_load[Base::wall_entry(scene_.interface[i / n], static_cast<int>(i % n))] = load_[i];
  }

  RobinCoefficient coefficient_;
  double alpha_;  ///< kPa/(mm/ms)
  MediumSystem<n> fluid_;
  std::vector<double> next_traction_;            ///< of the step in progress
  std::vector<double> load_;                     ///< of the wall in its last solution, kPa mm^2
  std::vector<double> whole_rows_;               ///< the fluid's, ghosts too
  double traction_size_ = 0, traction_gap_ = 0;  ///< kPa, of the last pass
  bool known_ = false;                           ///< lambda^n
  bool iterates_ = false;                        ///< in the step in progress
  std::vector<Data> changes_;                    ///< in the stages of the step in progress
  std::vector<double> datum_;                    ///< x of the last pass
};

}  // namespace fsi
