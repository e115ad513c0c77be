#pragma once

#include "time/time_integrator.hpp"

namespace fsi {

/// Known values in the rates of one balance: d_m, (u, p), (d_s, p_s) as Solution, and the wall's velocity.
struct References {
  Solution of;
  std::vector<double> wall_velocity;  ///< vectors per wall node, mm/ms
};

/// Schemes that treat displacements and velocities alike, as one system of first order (docs/theory.md, section 8.4):
/// the equations hold at a time of balance, t_b, for unknowns there, with
///   dy/dt = k (y - r),   y = d_m, u, d_s, v_s,
/// one k and references r made of finished levels. So v_s = k (d_s - r), eliminated, a = k (v_s - r_v), and fluid, wall
/// and mesh have one velocity on the interface. Pressures belong to t_b. Values at the stage's end are
/// y_0 + (y - y_0) / theta; pressures are brought there through those of other balances, as long as no jump of the load
/// lies between them.
/// \tparam n  components of a vector, 1 to 3
template <int n>
class BalanceScheme : public TimeIntegrator {
 public:
  void prepare(State& state) const override;
  /// From balances since the load last jumped, displacements and velocities from the level at the jump, too. Through a
  /// jump displacements go on with the wall's velocity.
  void predict(State& state, int order, const StepData& data) const override;
  std::array<double, 3> balance_weights(const State& state, int order, const StepData& data) const override;
  void accept(State& state, const StepData& data) const override;

  /// Rates of a balance; where it lies, and its loads, are left to the scheme.
  /// \param pressures  of an earlier balance, near in time
  StepRates rates_from(double step, double k, References references, const Solution& pressures) const;
  /// The finished level as references.
  static References level(const State& state) { return {state.before[0], state.wall_velocity}; }
  /// The level that a step of length `step` (ms) starts from, as references: the finished one; where the step changes
  /// after equal ones, its displacements moved by level_shift times the second derivative of the last three balances.
  References start(const State& state, double step) const;

 protected:
  /// Length of the state's last step, ms; `step`, the next one's, where there is none or they differ by the rounding of
  /// times alone: factors of equal steps are then equal, and a Jacobian made for them serves on.
  static double last_step(const State& state, double step);
  /// Sets the rates at the last level to zero, as at rest.
  static void prepare_rates(State& state);
  /// What else a scheme keeps of a finished step, from the level `start` to the level `end`.
  virtual void keep(State&, const StepData&, const Solution& /*start*/, const Solution& /*end*/,
                    const std::vector<double>& /*end_velocity*/) const {}
  /// ms^2. Displacements at levels are not those of balances but lie off their course by -theta (1 - theta) dt^2 / 2
  /// times its second derivative: what belongs to another step than the last one's has to change when the step does, or
  /// the next balances would correct it by wrong pressures at every step length (docs/theory.md, section 8.9).
  virtual double level_shift(const State&, double /*step*/) const { return 0; }

 private:
  static void push(State& state, Solution balance, double time);
};

/// Whether the pressures of the last level are final, because its balance lies there or the load jumps there; else the
/// next step sets them (TimeIntegrator::pressures_lag).
bool pressures_settled(const State& state);

/// a x + b y of two reference sets.
References combine(double a, const References& x, double b, const References& y);

extern template class BalanceScheme<1>;
extern template class BalanceScheme<2>;
extern template class BalanceScheme<3>;

}  // namespace fsi
