#pragma once

#include <vector>

#include "partitioned/accelerators/accelerator.hpp"
#include "partitioned/interface_space.hpp"

namespace fsi {

/// x += omega r. On Dirichlet-Neumann it converges for omega < 2 / (1 + |G|), G the ratio of the fluid's added mass to
/// the wall's mass and stiffness [Causin2005]: about 0.014 on the coarse artery.
class ConstantRelaxation : public Accelerator {
 public:
  explicit ConstantRelaxation(double factor) : factor_(factor) {}
  void start() override {}
  void correct(std::vector<double>& x, const std::vector<double>& r) override;
  AcceleratorStatus status() const override { return {factor_, 0}; }

 private:
  double factor_;
};

/// Aitken's dynamic relaxation ([Irons1969]; [Kuettler2008], equation 44):
///   omega_k = -(x_k - x_(k-1)) . (r_k - r_(k-1)) / |r_k - r_(k-1)|^2.
/// A step, or stage, starts with the magnitude of the last factor of the previous one, between 1e-4 and
/// `largest_start`: a first correction that overshoots can invert elements.
class AitkenRelaxation : public Accelerator {
 public:
  /// \param first_factor   of the first correction of all
  /// \param largest_start  bound on the first factor of each step
  AitkenRelaxation(double first_factor, double largest_start, const InterfaceSpace& space = {})
      : space_(space), factor_(first_factor), start_(first_factor), largest_start_(largest_start) {}
  void start() override;
  void correct(std::vector<double>& x, const std::vector<double>& r) override;
  void abandon() override { factor_ = start_; }
  AcceleratorStatus status() const override { return {factor_, 0}; }
  void keep(RestartArchive& archive) override;

 private:
  InterfaceSpace space_;
  double factor_, start_;  ///< and as it was when the step began
  double largest_start_;
  bool has_last_ = false;  ///< there was a pass before, of this step or stage:
  std::vector<double> last_x_, last_r_;
};

}  // namespace fsi
