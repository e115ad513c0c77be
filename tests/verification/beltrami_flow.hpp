#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "fluid/ale_fluid.hpp"
#include "support/errors.hpp"

namespace fsi::test {

/// Arnold-Beltrami-Childress flow times cos(omega t): curl u = k u, so that (grad u) u = grad |u|^2 / 2 is balanced by
/// p = -rho |u|^2 / 2; a load rho du/dt + mu k^2 u does the rest.
struct BeltramiFlow {
  double density, wave_number, frequency;  ///< mg/mm^3, 1/mm, omega in 1/ms
  static constexpr double strength[3] = {1.0, 0.7, 0.5};

  VectorAt velocity(const Point& x, double t = 0) const {
    const double k = wave_number, e = std::cos(frequency * t);
    const double sx = std::sin(k * x[0]), cx = std::cos(k * x[0]), sy = std::sin(k * x[1]), cy = std::cos(k * x[1]),
                 sz = std::sin(k * x[2]), cz = std::cos(k * x[2]);
    VectorAt u;
    const double a1 = e * strength[0], a2 = e * strength[1], a3 = e * strength[2];
    u.value = {a1 * sz + a3 * cy, a2 * sx + a1 * cz, a3 * sy + a2 * cx};
    u.gradient = {{{0, -k * a3 * sy, k * a1 * cz}, {k * a2 * cx, 0, -k * a1 * sz}, {-k * a2 * sx, k * a3 * cy, 0}}};
    return u;
  }
  double pressure(const Point& x, double t = 0) const {
    const auto u = velocity(x, t).value;
    return -0.5 * density * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  }

  /// The load that makes this flow a solution on cells standing at `nodes`, in the method's own consistent form: with
  /// the strong residual s = rho (du/dt + (grad u) u) + grad p of the exact flow,
  ///   (rho (du/dt + (grad u) u), v) + (sigma, grad v) + sum over elements (tau s, (grad v) c) - (tau s / rho, grad q),
  /// volume load and traction on open faces in one. Four numbers per node.
  /// \param mesh_velocity  w at the nodes, three numbers each, mm/ms
  template <class Cells>
  std::vector<double> load(const std::vector<Point>& nodes, const Cells& cells, const AleFluid& form, double t,
                           const std::vector<double>& mesh_velocity) const {
    std::vector<double> load(4 * nodes.size(), 0.0);
    integrate_cells(nodes, cells, [&](std::size_t cell, const CellPoint& at) {
      const auto u = velocity(at.x, t), shape = velocity(at.x, 0);
      const double p = pressure(at.x, t);
      // The pressure balances (grad u) u: what is left of the strong residual is rho du/dt.
      Point rate, c = u.value;
      for (int i = 0; i < 3; ++i) {
        rate[i] = -frequency * std::sin(frequency * t) * shape.value[i];
        for (int a = 0; a < 4; ++a) c[i] -= at.shape[a] * mesh_velocity[3 * cells[cell][a] + i];
      }
      const double tau = stabilisation_time(form, *at.gradient, c);
      for (int a = 0; a < 4; ++a) {
        const Point& gradient = (*at.gradient)[a];
        double* to = load.data() + 4 * cells[cell][a];
        double along = 0, across = 0;
        for (int j = 0; j < 3; ++j) {
          along += gradient[j] * c[j];
          across += gradient[j] * rate[j];
        }
        for (int i = 0; i < 3; ++i) {
          double convection = 0, flux = -gradient[i] * p;
          for (int j = 0; j < 3; ++j) {
            convection += u.gradient[i][j] * u.value[j];
            flux += gradient[j] * form.viscosity * (u.gradient[i][j] + u.gradient[j][i]);
          }
          to[i] += at.weight * (density * (at.shape[a] * (rate[i] + convection) + tau * rate[i] * along) + flux);
        }
        to[3] -= at.weight * tau * across;
      }
    });
    return load;
  }

 private:
  /// tau of docs/theory.md, section 3.2, on the current element, from 2 G = sum_a grad N_a grad N_a^T.
  static double stabilisation_time(const AleFluid& form, const std::array<Point, 4>& gradient, const Point& c) {
    const double nu = form.viscosity / form.density;
    double sum = 4 / (form.step * form.step);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double metric = 0;
        for (const auto& g : gradient) metric += 0.5 * g[i] * g[j];
        sum += c[i] * metric * c[j] + form.inverse_estimate * nu * nu * metric * metric;
      }
    return 1 / std::sqrt(sum);
  }
};

/// The inside of the face x = 0 of the unit cube, left open to the exact traction. With the solution prescribed on the
/// whole boundary the volume that the interpolated data enclose would not be conserved, or one pressure would have to
/// be held to absorb the defect.
inline bool open_face(const Point& x) {
  return x[0] == 0 && x[1] > 0 && x[1] < 1 && x[2] > 0 && x[2] < 1;
}

}  // namespace fsi::test
