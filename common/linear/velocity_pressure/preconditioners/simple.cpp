// linear.preconditioner = "simple".
#include <algorithm>
#include <cstddef>
#include <memory>

#include "fem/dimensions.hpp"
#include "linear/velocity_pressure/momentum_and_schur.hpp"

namespace fsi {

/// SIMPLE [Patankar1972] as a preconditioner: the momentum equations first, then pressures that make the velocities
/// continuous, and a correction by the diagonal D (MomentumDiagonals) in place of A:
///   w = A^-1 r_v,  p = S^-1 (r_p - B w),  v = w - D^-1 G p.
template <int n>
class Simple : public MomentumAndSchur<n> {
 public:
  using Matrix = VelocityPressureMatrix<n>;
  using MomentumAndSchur<n>::MomentumAndSchur;
  using FlowPreconditioner<n>::apply;

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
    matrix_.update_velocities(z.data());
    std::copy(pressure_.begin(), pressure_.end(), z.begin() + static_cast<std::ptrdiff_t>(matrix_.velocity_size()));
  }

 private:
  using FlowPreconditioner<n>::matrix_;
  using MomentumAndSchur<n>::momentum_;
  using MomentumAndSchur<n>::pressure_;
  using MomentumAndSchur<n>::right_;
  using MomentumAndSchur<n>::schur_;
  using MomentumAndSchur<n>::velocity_;
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
