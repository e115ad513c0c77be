#pragma once

#include <cstddef>
#include <vector>

#include "linear/velocity_pressure/flow_preconditioner.hpp"
#include "linear/velocity_pressure/flow_schur_complement.hpp"
#include "linear/velocity_pressure/momentum_inverse.hpp"

namespace fsi {

/// What preconditioners by block factors have in common: the approximate inverses of the momentum equations and of their Schur
/// complement, whose inner diagonal is that of MomentumDiagonals, and vectors to work in. The order of the factors is theirs.
template <int n>
class MomentumAndSchur : public FlowPreconditioner<n> {
 public:
  using Matrix = VelocityPressureMatrix<n>;

  explicit MomentumAndSchur(const Matrix& matrix)
      : FlowPreconditioner<n>(matrix),
        momentum_(matrix),
        schur_(matrix),
        right_(matrix.velocity_size()),
        velocity_(matrix.velocity_size()),
        pressure_(matrix.layout().pressures) {}

  void set_up(const BlockPreconditionerChoices& choices) final {
    momentum_.set_up(choices);
    schur_.set_up(choices, momentum_);
  }

  std::size_t bytes() const final {
    return momentum_.bytes() + schur_.bytes() + sizeof(float) * (right_.size() + velocity_.size() + pressure_.size());
  }
  int levels() const final { return schur_.inverse().levels(); }
  double operator_complexity() const final { return schur_.inverse().operator_complexity(); }

 protected:
  using FlowPreconditioner<n>::matrix_;

  MomentumInverse<n> momentum_;
  FlowSchurComplement<n> schur_;
  std::vector<float> right_, velocity_, pressure_;  // of the momentum equations, velocities, pressures
};

}  // namespace fsi
