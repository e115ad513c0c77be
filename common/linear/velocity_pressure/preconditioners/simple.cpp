// linear.preconditioner = "simple".
#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "fem/dimensions.hpp"
#include "linear/velocity_pressure/flow_preconditioner.hpp"
#include "linear/velocity_pressure/flow_schur_complement.hpp"
#include "linear/velocity_pressure/momentum_inverse.hpp"

namespace fsi {

/// SIMPLE [Patankar1972] as a preconditioner: the momentum equations first, then pressures that make the velocities
/// continuous, and a correction by the diagonal D (MomentumDiagonals) in place of A:
///   w = A^-1 r_v,  p = S^-1 (r_p - B w),  v = w - D^-1 G p.
template <int n>
class Simple : public FlowPreconditioner<n> {
 public:
  using Matrix = VelocityPressureMatrix<n>;
  using FlowPreconditioner<n>::apply;

  explicit Simple(const Matrix& matrix)
      : FlowPreconditioner<n>(matrix),
        momentum_(matrix),
        schur_(matrix),
        right_(matrix.velocity_size()),
        velocity_(matrix.velocity_size()),
        pressure_(matrix.layout().pressures) {}

  void set_up(const BlockPreconditionerChoices& choices) override {
    momentum_.set_up(choices);
    schur_.set_up(choices, momentum_);
  }

  void apply(VectorView<const float> r, VectorView<float> z) override {
    std::copy_n(r.begin(), right_.size(), right_.begin());
    momentum_.apply(right_, velocity_);
    schur_.apply(r.data() + matrix_.velocity_size(), velocity_, pressure_);
    momentum_.for_velocities([&](int v) {
      const std::size_t at = static_cast<std::size_t>(v) * Matrix::lanes;
      Matrix::store(
          Matrix::load(velocity_.data() + at) - Matrix::load(momentum_.single_inverse_diagonal().data() + at) *
                                                    matrix_.gradient_product(v, pressure_.data()),
          z.data() + at);
    });
    std::copy(pressure_.begin(), pressure_.end(), z.begin() + static_cast<std::ptrdiff_t>(matrix_.velocity_size()));
  }

  std::size_t bytes() const override {
    return momentum_.bytes() + schur_.bytes() + sizeof(float) * (right_.size() + velocity_.size() + pressure_.size());
  }
  int levels() const override { return schur_.inverse().levels(); }
  double operator_complexity() const override { return schur_.inverse().operator_complexity(); }

 private:
  using FlowPreconditioner<n>::matrix_;

  MomentumInverse<n> momentum_;
  FlowSchurComplement<n> schur_;
  std::vector<float> right_, velocity_, pressure_;
};

template <int n>
std::unique_ptr<FlowPreconditioner<n>> make_simple(const VelocityPressureMatrix<n>& matrix) {
  return std::make_unique<Simple<n>>(matrix);
}

// NOLINTBEGIN(bugprone-macro-parentheses)
#define FSI_INSTANTIATE(n) \
  template std::unique_ptr<FlowPreconditioner<n>> make_simple(const VelocityPressureMatrix<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fsi
