#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/material.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// The wall as a membrane on the interface, from which the Robin conditions take their coefficients.
struct Membrane {
  double area = 0;                 ///< of the interface, mm^2
  double thickness = 0;            ///< h, wall volume over interface area, mm
  double radius = 0;               ///< R, twice the fluid's volume over the interface's area: a tube's radius, mm
  double density = 0;              ///< rho_s, mg/mm^3
  double shear_modulus = 0;        ///< mean over the thickness, kPa
  double tension = 0;              ///< E h / (1 - nu^2) along the circumference, kPa mm
  std::vector<double> node_areas;  ///< per interface node here, mm^2

  /// Hoop stiffness E h / ((1 - nu^2) R^2): pressure per normal displacement, kPa/mm.
  double stiffness() const { return tension / (radius * radius); }
  /// Response time of the wall's ring, ms: R sqrt(rho_s (1 - nu^2) / E).
  double answer_time() const { return std::sqrt(density * thickness / stiffness()); }
  /// Pressure per normal displacement within a step, kPa/mm, a being `acceleration_factor` (1/ms^2):
  ///   a rho_s h + E h / ((1 - nu^2) R^2).
  double push_stiffness(double acceleration_factor) const {
    return acceleration_factor * density * thickness + stiffness();
  }

  /// Traction per normal velocity, kPa/(mm/ms), within a step: dt (a rho_s h + E h / ((1 - nu^2) R^2)), z_n below. With
  /// this coefficient a Robin-Neumann pass removes the error of long waves of the normal velocity. For other modes it
  /// is too large, and the quasi-Newton method removes their errors. By trial the best for these passes is within a
  /// factor of 1.2 of it (docs/coupling.md).
  /// \param acceleration_factor  a, 1/ms^2 (StepRates)
  /// \param step                 dt, ms: InterfaceKinematics::period, not the length of the step
  double normal_impedance(double acceleration_factor, double step) const {
    return step * push_stiffness(acceleration_factor);
  }

  static constexpr double smallest_depth = 0.05;  ///< l / h in impedance()

  /// Traction per interface velocity, kPa/(mm/ms), with which the wall responds within a step whose acceleration is
  /// `acceleration_factor` (1/ms^2) times the displacement. Pushed outward, its whole thickness moves, and the hoop
  /// stretches; pushed along, it shears, and inertia is felt to a depth of l only:
  ///   z_n = dt (a rho_s h + E h / ((1 - nu^2) R^2)),   z_t = dt a rho_s l tanh(h / l),   l = sqrt(mu / (a rho_s)).
  /// A Robin-Neumann pass with coefficient alpha multiplies the error of a mode, z being the wall's impedance for it
  /// and f the fluid's, by (1 - alpha / z) f / (f + alpha). Where the added mass is large the last factor is one, and
  /// best for all z from z_t to z_n is their harmonic mean, alpha = 2 / (1/z_n + 1/z_t): within a tenth the best by
  /// trial for time steps from a tenth to four times the artery's, and for a wall ten times softer. l counts as h/20 at
  /// least: where it is a small part of an element, the inertia is that of the nodal mass.
  /// \param step  dt, as for normal_impedance()
  double impedance(double acceleration_factor, double step) const {
    const double inertia = acceleration_factor * density;
    const double depth = std::max(std::sqrt(shear_modulus / inertia), smallest_depth * thickness);
    const double across = step * push_stiffness(acceleration_factor);
    const double along = step * inertia * depth * std::tanh(thickness / depth);
    return 2 / (1 / across + 1 / along);
  }
};

/// Of a scene with fluid and wall. Collective: areas and volumes are those of all processes.
template <int n>
Membrane membrane_of(const Scene<n>& scene) {
  Membrane m;
  m.node_areas = scene.interface_areas;
  m.area = scene.interface_area();
  m.density = scene.wall->constants().density;
  m.radius = 2 * scene.fluid->volume() / m.area;
  for (const auto& layer : scene.wall->layer_data()) {
    const double h = layer.volume / m.area;
    m.thickness += h;
    m.shear_modulus += shear_modulus(layer.material) * h;
    m.tension += layer.sudden_hoop_modulus(scene.wall->constants().bulk_modulus) * h;
  }
  m.shear_modulus /= m.thickness;
  return m;
}

}  // namespace fsi
