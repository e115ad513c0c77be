#pragma once

#include <cstddef>
#include <vector>

#include "fem/contributions.hpp"
#include "materials/maxwell_branch.hpp"

namespace fsi {

/// Green-Lagrange strain E = (H + H^T + H^T H)/2 of H = grad d.
template <class T>
Sym3<T> green_lagrange(const Mat3<T>& h) {
  Sym3<T> e;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      e(i, j) = Pack(0.5) * (h(i, j) + h(j, i) + h(0, i) * h(0, j) + h(1, i) * h(1, j) + h(2, i) * h(2, j));
  return e;
}

/// What the branches of a layer add to its residual at a balance whose rates are k (y - r) (docs/theory.md, section 5.11).
/// Branch i keeps the strain A_i of its dashpot, dA_i/dt = (E - A_i)/tau_i, and so there
///   A_i = (E + k tau_i r_i)/(1 + k tau_i),   Q_i = 2 G_i (E - A_i) = w_i (E - r_i),   w_i = 2 G_i k tau_i/(1 + k tau_i)
/// and (F sum Q_i, grad w) for test functions w: explicit in the displacement.
class MaxwellForm {
 public:
  /// \param rate  k, 1/ms
  MaxwellForm(const std::vector<MaxwellBranch>& branches, double rate) {
    for (const auto& branch : branches) {
      weights_.push_back(2 * branch.shear * rate * branch.time / (1 + rate * branch.time));
      total_ += weights_.back();
    }
  }

  template <class T>
  struct Prepared {
    Mat3<T> gradient;  ///< F
    Sym3<T> stress;    ///< sum of w_i E
  };

  /// w_i, kPa
  double weight(std::size_t branch) const { return weights_[branch]; }
  std::size_t count() const { return weights_.size(); }

  /// \param grad_d  from the unloaded shape
  template <class T>
  Prepared<T> prepare(const Mat3<T>& grad_d) const {
    Mat3<T> f = grad_d;
    for (int i = 0; i < 3; ++i) f(i, i) += Pack(1.0);
    return {f, Pack(total_) * green_lagrange(grad_d)};
  }

  /// The term at a point: a flux, and nothing else. \param history  sum of w_i r_i there, kPa
  template <class T>
  Integrand<T> integrand(const Prepared<T>& k, const Sym3<Pack>& history) const {
    Integrand<T> f;
    for (int i = 0; i < 3; ++i) f.source[i] = f.scalar_flux[i] = T(0.0);
    f.scalar_source = T(0.0);
    f.flux = k.gradient * (k.stress - history);
    return f;
  }

 private:
  std::vector<double> weights_;
  double total_ = 0;
};

}  // namespace fsi
