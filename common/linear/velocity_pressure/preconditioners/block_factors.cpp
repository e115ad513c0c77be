// linear.preconditioner = "block-factors", the default.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "fem/dimensions.hpp"
#include "linear/velocity_pressure/momentum_and_schur.hpp"

namespace fsi {

/// The block factors of F with the diagonal D (MomentumDiagonals) in place of A where pressures are sought:
///   p = S^-1 (r_p - B D^-1 r_v),  v = A^-1 (r_v - G p).
template <int n>
class BlockFactors : public MomentumAndSchur<n> {
 public:
  using Matrix = VelocityPressureMatrix<n>;

  using MomentumAndSchur<n>::MomentumAndSchur;

  void apply(VectorView<const float> r, VectorView<float> z) override {
    const std::vector<float>& inverse_diagonal = momentum_.single_inverse_diagonal();
    for (std::size_t i = 0; i < right_.size(); ++i) right_[i] = inverse_diagonal[i] * r[i];
    matrix_.update_velocities(right_.data());
    schur_.apply(r.data() + matrix_.velocity_size(), right_, pressure_);
    const int velocities = matrix_.layout().own_velocities;
    parallel_for(velocities, velocities > 2000, [&](int v) {
      const std::size_t at = static_cast<std::size_t>(v) * Matrix::lanes;
      Matrix::store(Matrix::load(r.data() + at) - matrix_.gradient_product(v, pressure_.data()), right_.data() + at);
    });
    momentum_.apply(right_, velocity_);
    std::copy(velocity_.begin(), velocity_.end(), z.begin());
    std::copy(pressure_.begin(), pressure_.end(), z.begin() + static_cast<std::ptrdiff_t>(matrix_.velocity_size()));
  }

  /// A v + G p = r - right_ + A v.
  void apply(VectorView<const float> r, VectorView<float> z, VectorView<float> product) override {
    apply(r, z);
    momentum_.for_velocities([&](int v) {
      const std::size_t at = static_cast<std::size_t>(v) * Matrix::lanes;
      Matrix::store(momentum_.row(Matrix::load(r.data() + at), v), product.data() + at);
    });
    matrix_.multiply_continuity(z, product);
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
std::unique_ptr<FlowPreconditioner<n>> make_block_factors(const VelocityPressureMatrix<n>& matrix) {
  return std::make_unique<BlockFactors<n>>(matrix);
}

// NOLINTBEGIN(bugprone-macro-parentheses)
#define FSI_INSTANTIATE(n) \
  template std::unique_ptr<FlowPreconditioner<n>> make_block_factors(const VelocityPressureMatrix<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fsi
