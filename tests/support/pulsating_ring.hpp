#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include "case/case.hpp"
#include "support/inflated_tube.hpp"
#include "support/polynomial_fit.hpp"

namespace fsi::test {

/// The pulsating ring of docs/theory.md, section 13.2: blood between a porous cylinder, through which pressure drives
/// it in, and the incompressible two-layer wall of section 13.1, in plane strain. a is the current inner radius of the
/// wall, q = a da/dt the flow per radian, u_r = q/r.
struct PulsatingRing {
  Tube tube;
  double fluid_density = 1, viscosity = 3.5e-3, wall_density = 1.2;  ///< mg/mm^3, kPa ms

  static constexpr double porous_radius = 0.5;  ///< r0, mm

  /// S(a), kPa.
  double static_pressure(double a) const {
    return has_fibres(tube.layers[0].material) ? inflation_pressure(tube, a) : isotropic_inflation_pressure(tube, a);
  }
};

/// Motion of the ring in continuous time.
struct RingMotion {
  double a = inner_radius;  ///< mm
  double q = 0;             ///< mm^2/ms
};

/// dq/dt: rho_f and rho_s times what accelerates, against the pressure.
inline double flow_rate_change(const PulsatingRing& ring, const RingMotion& at, double pressure) {
  const double a2 = at.a * at.a, b2 = a2 + outer_radius * outer_radius - inner_radius * inner_radius;
  const double r02 = ring.porous_radius * ring.porous_radius;
  const double mass =
      ring.fluid_density * std::log(at.a / ring.porous_radius) + ring.wall_density * 0.5 * std::log(b2 / a2);
  const double convection = ring.fluid_density * (1 / a2 - 1 / r02) + ring.wall_density * (1 / b2 - 1 / a2);
  return (pressure - 0.5 * at.q * at.q * convection - 2 * ring.viscosity * at.q * (1 / r02 - 1 / a2) -
          ring.static_pressure(at.a)) /
         mass;
}

/// One step of the classical Runge-Kutta method.
inline RingMotion moved_on(const PulsatingRing& ring, const RingMotion& now, double pressure, double h) {
  const auto moved = [&](const RingMotion& slope, double by) {
    return RingMotion{now.a + by * slope.a, now.q + by * slope.q};
  };
  const auto slope = [&](const RingMotion& at) {
    return RingMotion{at.q / at.a, flow_rate_change(ring, at, pressure)};
  };
  const auto k1 = slope(now), k2 = slope(moved(k1, h / 2)), k3 = slope(moved(k2, h / 2)), k4 = slope(moved(k3, h));
  return {now.a + h / 6 * (k1.a + 2 * k2.a + 2 * k3.a + k4.a), now.q + h / 6 * (k1.q + 2 * k2.q + 2 * k3.q + k4.q)};
}

/// Goes on under a constant pressure in steps of at most `step`. Fibres of the whole wall begin to act at a = R_i, where
/// S(a) has a kink: a step ends there.
inline void march_on(const PulsatingRing& ring, RingMotion& now, double pressure, double time, double step) {
  const int steps = static_cast<int>(std::ceil(time / step - 1e-9));
  const double h = time / steps;
  for (int i = 0; i < steps; ++i) {
    RingMotion next = moved_on(ring, now, pressure, h);
    if ((now.a - inner_radius) * (next.a - inner_radius) < 0) {
      double before = 0, gap_before = now.a - inner_radius, part = h / 2;
      for (int k = 0; k < 20; ++k) {  // secant method
        const double gap = moved_on(ring, now, pressure, part).a - inner_radius;
        if (gap == gap_before) break;
        const double better = part - gap * (part - before) / (gap - gap_before);
        before = part;
        gap_before = gap;
        part = better;
      }
      next = moved_on(ring, moved_on(ring, now, pressure, part), pressure, h - part);
    }
    now = next;
  }
}

/// From rest, under a pressure that is constant until `off` and zero then, in steps of at most `step`, one of which ends
/// at the jump.
inline RingMotion ring_motion(const PulsatingRing& ring, double pressure, double off, double time, double step) {
  RingMotion now;
  march_on(ring, now, pressure, std::min(off, time), step);
  if (time > off) march_on(ring, now, 0, time - off, step);
  return now;
}

/// The fluid's pressure at the wall, kPa: what the wall feels less the viscous normal stress.
inline double pressure_at_wall(const PulsatingRing& ring, const RingMotion& at, double pressure) {
  const double a2 = at.a * at.a, b2 = a2 + outer_radius * outer_radius - inner_radius * inner_radius;
  const double felt =
      ring.static_pressure(at.a) + ring.wall_density * (flow_rate_change(ring, at, pressure) * 0.5 * std::log(b2 / a2) +
                                                        0.5 * at.q * at.q * (1 / b2 - 1 / a2));
  return felt - 2 * ring.viscosity * at.q / a2;
}

/// The ring as the toolkit steps it, and exact in space: backward Euler for fluid and interface, Newmark's method with
/// beta = gamma = 1 for the wall, the mesh between cylinder and wall moved harmonically. A field that is radial at one
/// level stays so, since pressures balance any radial force: each step leaves one equation for a. What a computation
/// differs from this is its error in space alone, at any step and amplitude.
class SteppedRing {
 public:
  /// \param step  ms
  SteppedRing(const PulsatingRing& ring, double step) : ring_(ring), step_(step) {}

  /// \param pressure  kPa, mean over the step
  void advance(double pressure) {
    pressure_ = pressure;
    a_.push_back(a_.back());
    // Secant method; the wall's answer is smooth.
    double before = a_.back(), gap_before = imbalance();
    double now = before + 1e-4;
    for (int i = 0; i < 50 && now != before; ++i) {
      a_.back() = now;
      const double gap = imbalance();
      if (gap == gap_before) break;
      const double next = now - gap * (now - before) / (gap - gap_before);
      before = now;
      gap_before = gap;
      now = next;
    }
  }

  double inner_radius_now() const { return a_.back(); }
  /// Of the wall, at reference radius R, mm.
  double displacement(double big_r) const { return radius(big_r, last()) - big_r; }
  /// Of the fluid, where the mesh point of reference radius R is, mm/ms.
  double velocity(double big_r) const { return flow(last()) / mesh_radius(big_r, last()); }
  /// Of the mesh, mm.
  double mesh_displacement(double big_r) const { return mesh_radius(big_r, last()) - big_r; }

  /// R of the mesh point that is at radius r, mm.
  double reference_radius(double r) const {
    double big_r = r;
    for (int k = 0; k < 20; ++k) {
      const double beyond = mesh_radius(big_r, last()) - r;
      big_r -= beyond / mesh_radius_slope(big_r, last());
      if (std::abs(beyond) < 1e-14) break;
    }
    return big_r;
  }
  /// kPa, where the mesh point of reference radius R is.
  double fluid_pressure(double big_r) const {
    const double r0 = ring_.porous_radius;
    return pressure_ - 2 * ring_.viscosity * flow(last()) / (r0 * r0) - fluid_inertia(big_r);
  }
  /// p of the wall, kPa, in a layer at reference radius R: minus a third of the trace of Cauchy's stress.
  double wall_pressure(std::size_t layer, double big_r) const {
    double radial_stress = 0;  // from the free outer face
    for (std::size_t l = layer; l < ring_.tube.layers.size(); ++l)
      radial_stress -= wall_force(ring_.tube.layers[l], l == layer ? big_r : ring_.tube.layers[l].inner);
    return deviatoric_radial_stress(ring_.tube.layers[layer].material, radius(big_r, last()) / big_r) - radial_stress;
  }

 private:
  std::size_t last() const { return a_.size() - 1; }
  /// q at the end of step n.
  double flow(std::size_t n) const { return n == 0 ? 0.0 : a_[n] * (a_[n] - a_[n - 1]) / step_; }
  double radius(double big_r, std::size_t n) const {
    return std::sqrt(big_r * big_r + a_[n] * a_[n] - inner_radius * inner_radius);
  }
  double mesh_radius(double big_r, std::size_t n) const {
    const double s = big_r / ring_.porous_radius, end = inner_radius / ring_.porous_radius;
    return big_r + (a_[n] - inner_radius) * (s - 1 / s) / (end - 1 / end);
  }
  double mesh_radius_slope(double big_r, std::size_t n) const {
    const double s = big_r / ring_.porous_radius, end = inner_radius / ring_.porous_radius;
    return 1 + (a_[n] - inner_radius) * (1 + 1 / (s * s)) / (end - 1 / end) / ring_.porous_radius;
  }

  /// Integral of rho (du/dt + (u - w) du/dr) dr from the cylinder to a mesh point, kPa.
  double fluid_inertia(double to) const {
    const std::size_t n = last();
    return gauss_integral(ring_.porous_radius, to, 60, [&](double big_r) {
      const double r = mesh_radius(big_r, n), old = mesh_radius(big_r, n - 1);
      const double u = flow(n) / r, u_old = flow(n - 1) / old, w = (r - old) / step_;
      return ring_.fluid_density * ((u - u_old) / step_ - (u - w) * u / r) * mesh_radius_slope(big_r, n);
    });
  }

  /// Newmark's acceleration of a point of the wall, mm/ms^2.
  double acceleration(double big_r) const {
    double d_old = 0, v = 0, acceleration = 0;
    for (std::size_t n = 1; n <= last(); ++n) {
      const double d = radius(big_r, n) - big_r;
      acceleration = (d - d_old) / (step_ * step_) - v / step_ + 0.5 * acceleration;
      v += step_ * acceleration;
      d_old = d;
    }
    return acceleration;
  }
  /// What the radial stress rises by over the rest of a layer, from a reference radius outwards, kPa: integral of
  /// rho a + (sigma_tt - sigma_rr)/r, with dr = R/r dR.
  double wall_force(const TubeLayer& layer, double from) const {
    return gauss_integral(from, layer.outer, 12, [&](double big_r) {
      const double r = radius(big_r, last());
      return (ring_.wall_density * acceleration(big_r) + hoop_stress_difference(layer.material, r / big_r) / r) *
             big_r / r;
    });
  }
  /// What the pressure lacks to carry fluid and wall with the last a, kPa.
  double imbalance() const {
    double wall = 0;
    for (const auto& layer : ring_.tube.layers) wall += wall_force(layer, layer.inner);
    const double a = a_.back();
    const double at_wall = fluid_pressure(inner_radius) + 2 * ring_.viscosity * flow(last()) / (a * a);
    return at_wall - wall;
  }

  /// Of Cauchy's stress without p, at circumferential stretch s, radial stretch 1/s and axial stretch 1, kPa.
  static double deviatoric_radial_stress(const Material& material, double s) {
    const double square = 1 / (s * s), i1 = s * s + square + 1;  // = I_2
    if (const auto* m = std::get_if<NeoHookean>(&material)) return m->c10 * (square - i1 / 3);
    if (const auto* m = std::get_if<MooneyRivlin>(&material))
      return m->c10 * (square - i1 / 3) + m->c01 * (i1 * square - square * square - 2 * i1 / 3);
    const auto& m = std::get<Artery>(material);
    const double c = std::cos(m.fibre_angle()), i4 = s * s * c * c + 1 - c * c, e = i4 - 1;
    return m.c10 * (square - i1 / 3) - (e > 0 ? 4.0 / 3 * m.k1 * std::exp(m.k2 * e * e) * e * i4 : 0.0);
  }

  PulsatingRing ring_;
  double step_, pressure_ = 0;
  std::vector<double> a_{inner_radius};  ///< at the ends of the steps, mm
};

}  // namespace fsi::test
