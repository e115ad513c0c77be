#pragma once

#include "time/time_integrator.hpp"

namespace fsi {

/// Backward Euler for the fluid, the mesh and the interface, Newmark's method for the wall (docs/theory.md, section 8):
///   du/dt = (u^n - u^(n-1)) / dt,   u = (d^n - d^(n-1)) / dt on the interface,
///   a^n = (d^n - d^(n-1)) / (beta dt^2) - v^(n-1) / (beta dt) - (1/(2 beta) - 1) a^(n-1),
///   v^n = v^(n-1) + dt (gamma a^n + (1 - gamma) a^(n-1)).
/// \tparam Components  of a vector
template <int Components>
class EulerNewmark : public TimeIntegrator {
 public:
  explicit EulerNewmark(const NewmarkParameters& newmark = {}) : newmark_(newmark) {}

  ErrorTerms error_terms() const override { return {1, 0.5}; }
  bool bears_one_pass() const override { return true; }
  NewmarkParameters newmark() const override { return newmark_; }
  void accept(State& state, const StepData& data) const override;

 private:
  StepRates rates_of(const State& state, double step, int stage) const override;

  NewmarkParameters newmark_;
};

extern template class EulerNewmark<1>;
extern template class EulerNewmark<2>;
extern template class EulerNewmark<3>;

}  // namespace fsi
