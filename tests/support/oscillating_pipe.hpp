#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "support/bessel_series.hpp"
#include "support/inflated_tube.hpp"
#include "support/polynomial_fit.hpp"

namespace fsi::test {

/// Factors of rates of fields that change as e^(i w t): du/dt = first u, acceleration of the wall = second d, velocity
/// of the interface and of the wall = first d and wall_velocity d.
struct HarmonicRates {
  Complex first, second, wall_velocity;

  /// In continuous time.
  static HarmonicRates continuous(double w) { return {{0, w}, -w * w, {0, w}}; }
  /// Of backward Euler, and of Newmark's method with beta = gamma = 1, in steps of this length:
  /// a (1 - 1/(2 z)) = d (1 - 1/z)/dt^2 - v/(z dt), v (1 - 1/z) = dt a, with z = e^(i w dt).
  static HarmonicRates stepped(double w, double step) {
    const Complex z = std::exp(Complex(0, w * step)), change = 1.0 - 1.0 / z;
    const Complex second = change / (step * step) / (1.0 - 0.5 / z + 1.0 / (z * change));
    return {change / step, second, step * second / change};
  }
};

/// The oscillating pipe of docs/theory.md, section 13.3: blood and wall of section 13.1 move along the axis alone under
/// the pressure gradient -P cos(w t); the wall's outer face is held. Fields are real parts of what is given times
/// e^(i w t). With viscous layers of Kelvin and Voigt's kind the shear modulus is mu + eta/2 first, first being i w in
/// continuous time: where the shear is small, since their stress is of third degree in it. The wave number across a layer,
/// k^2 = -rho second / (mu + eta/2 first), is then complex.
class OscillatingPipe {
 public:
  double frequency = 1;  ///< w, rad/ms
  double gradient;       ///< P, kPa/mm
  double fluid_density = 1, viscosity = 3.5e-3, wall_density = 1.2;

  /// \param wall_viscosity  eta of both layers, kPa ms
  OscillatingPipe(const Tube& tube, const HarmonicRates& rates, double of_pressure = 0.1, double wall_viscosity = 0)
      : gradient(of_pressure), tube_(tube), rates_(rates) {
    l_ = std::sqrt(-rates.first * fluid_density / viscosity);
    for (int i = 0; i < 2; ++i) {
      mu_[i] = std::visit([](const auto& m) { return m.shear_modulus(); }, tube.layers[i].material) +
               0.5 * wall_viscosity * rates.first;
      k_[i] = std::sqrt(-rates.second * wall_density / mu_[i]);
    }
    // Unknowns: A J0(l Ri), B and C of both layers. Rows: u = first d and equal shear stresses at the inner face, d and
    // mu d' continuous between the layers, d = 0 at the outer face.
    const Bessel f(l_ * inner_radius), in(k_[0] * inner_radius), mid0(k_[0] * middle_radius),
        mid1(k_[1] * middle_radius), out(k_[1] * outer_radius);
    const Complex s = rates.first, m0 = mu_[0] * k_[0], m1 = mu_[1] * k_[1];
    solve({{{1.0, -s * in.j0, -s * in.y0, 0.0, 0.0, s * wall_mean() - fluid_mean()},
            {-viscosity * l_ * f.j1 / f.j0, m0 * in.j1, m0 * in.y1, 0.0, 0.0, 0.0},
            {0.0, mid0.j0, mid0.y0, -mid1.j0, -mid1.y0, 0.0},
            {0.0, -m0 * mid0.j1, -m0 * mid0.y1, m1 * mid1.j1, m1 * mid1.y1, 0.0},
            {0.0, 0.0, 0.0, out.j0, out.y0, -wall_mean()}}});
  }

  /// Axial velocity of the fluid, mm/ms.
  Complex velocity(double r) const {
    return coefficient_[0] * Bessel(l_ * r).j0 / Bessel(l_ * inner_radius).j0 + fluid_mean();
  }
  /// mu_f du/dr, kPa.
  Complex shear_stress(double r) const {
    return -viscosity * l_ * coefficient_[0] * Bessel(l_ * r).j1 / Bessel(l_ * inner_radius).j0;
  }
  /// Axial displacement of a layer, mm, and its slope.
  Complex displacement(int layer, double r) const {
    const Bessel b(k_[layer] * r);
    return coefficient_[1 + 2 * layer] * b.j0 + coefficient_[2 + 2 * layer] * b.y0 + wall_mean();
  }
  Complex slope(int layer, double r) const {
    const Bessel b(k_[layer] * r);
    return -k_[layer] * (coefficient_[1 + 2 * layer] * b.j1 + coefficient_[2 + 2 * layer] * b.y1);
  }
  const HarmonicRates& rates() const { return rates_; }
  const Tube& tube() const { return tube_; }

  /// The real part of a field at time t.
  double at(double t, Complex amplitude) const { return (amplitude * std::exp(Complex(0, frequency * t))).real(); }
  double gradient_at(double t) const { return gradient * std::cos(frequency * t); }

 private:
  Complex fluid_mean() const { return gradient / (rates_.first * fluid_density); }
  Complex wall_mean() const { return gradient / (rates_.second * wall_density); }

  /// Gauss's method with row pivoting on [matrix | right-hand side].
  void solve(std::array<std::array<Complex, 6>, 5> m) {
    for (int c = 0; c < 5; ++c) {
      int best = c;
      for (int r = c + 1; r < 5; ++r)
        if (std::abs(m[r][c]) > std::abs(m[best][c])) best = r;
      std::swap(m[c], m[best]);
      for (int r = 0; r < 5; ++r) {
        if (r == c) continue;
        const Complex factor = m[r][c] / m[c][c];
        for (int j = c; j < 6; ++j) m[r][j] -= factor * m[c][j];
      }
    }
    for (int c = 0; c < 5; ++c) coefficient_[c] = m[c][5] / m[c][c];
  }

  Tube tube_;
  HarmonicRates rates_;
  Complex l_;
  std::array<Complex, 2> mu_{}, k_{};
  std::array<Complex, 5> coefficient_{};
};

}  // namespace fsi::test
