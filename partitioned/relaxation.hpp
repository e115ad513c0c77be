#pragma once

#include <memory>
#include <string>
#include <vector>

namespace fsi {

/// How a fixed-point iteration on the interface displacement goes on from a guess d and the wall's answer d~, given
/// their difference, the interface residual r = d~ - d.
class Relaxation {
 public:
  virtual ~Relaxation() = default;
  /// A new time step begins.
  virtual void start() = 0;
  /// d += its correction for the residual r.
  virtual void correct(std::vector<double>& d, const std::vector<double>& r) = 0;
  /// The factor last used, for the log.
  virtual double factor() const = 0;
  /// Restores the factor after a restart.
  virtual void set_factor(double factor) = 0;
};

/// d += omega r. Converges for omega < 2 / (1 + |G|), G the ratio of the fluid's added mass to the wall's mass and
/// stiffness: about 0.014 on the coarse artery.
class ConstantRelaxation : public Relaxation {
 public:
  explicit ConstantRelaxation(double factor) : factor_(factor) {}
  void start() override {}
  void correct(std::vector<double>& d, const std::vector<double>& r) override;
  double factor() const override { return factor_; }
  void set_factor(double) override {}

 private:
  double factor_;
};

/// Aitken's dynamic relaxation (Irons and Tuck 1969; Kuettler and Wall 2008, equation 44):
///   omega_k = -omega_(k-1) r_(k-1) . (r_k - r_(k-1)) / |r_k - r_(k-1)|^2.
/// A step starts with the last factor of the previous one, no larger than `largest_start`: a first guess that
/// overshoots can invert elements.
class AitkenRelaxation : public Relaxation {
 public:
  static constexpr double largest_start = 0.05;

  explicit AitkenRelaxation(double first_factor) : factor_(first_factor) {}
  void start() override;
  void correct(std::vector<double>& d, const std::vector<double>& r) override;
  double factor() const override { return factor_; }
  void set_factor(double factor) override { factor_ = factor; }

 private:
  double factor_;
  std::vector<double> last_;
};

/// By the case file's name, "constant" or "aitken"; `factor` 0 lets the scheme choose.
/// \throws InputError for another name
std::unique_ptr<Relaxation> make_relaxation(const std::string& scheme, double factor);

}  // namespace fsi
