#pragma once

#include <array>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "wall/wall_problem.hpp"

namespace fsi::test {

/// One layer of the closed tube of docs/theory.md, section 13.1: rabbit carotid of section 1.3.
struct TubeLayer {
  const char* name;
  double inner, outer;  ///< reference radii, mm
  Material material;
};
struct Tube {
  const char* name;
  std::array<TubeLayer, 2> layers;
  /// The row of the table: pressure in kPa at a / R_i = 1.001, 1.005, 1.01, 1.02, 1.05, 1.1, 1.2, 1.3, 1.4.
  std::array<double, 9> table;
};

inline void PrintTo(const Tube& tube, std::ostream* out) {
  *out << tube.name;
}

inline constexpr double inner_radius = 1.43, middle_radius = 1.69, outer_radius = 1.82;  // mm
inline constexpr std::array<double, 9> table_stretches = {1.001, 1.005, 1.01, 1.02, 1.05, 1.1, 1.2, 1.3, 1.4};

inline std::array<Tube, 3> tubes() {
  const auto tube = [](const char* name, Material media, Material adventitia, std::array<double, 9> table) {
    return Tube{name,
                {TubeLayer{"media", inner_radius, middle_radius, media},
                 TubeLayer{"adventitia", middle_radius, outer_radius, adventitia}},
                table};
  };
  return {tube("neo-Hookean", NeoHookean{3}, NeoHookean{0.3},
               {.0018, .0087, .0173, .0339, .0798, .1452, .2441, .3131, .3623}),
          tube("Mooney-Rivlin", MooneyRivlin{3, 0.3}, MooneyRivlin{0.3, 0.2},
               {.0020, .0098, .0193, .0379, .0893, .1626, .2736, .3511, .4064}),
          tube("artery", Artery{3, 2.3632, 0.8393, 1, 29}, Artery{0.3, 0.5620, 0.7112, 1, 62},
               {.0033, .0167, .0332, .0658, .1612, .3140, .6174, .9620, 1.4252})};
}

/// sigma_theta - sigma_r of an incompressible layer at circumferential stretch s and axial stretch 1, from the energies
/// of docs/theory.md, section 5: I_1 = I_2 = s^2 + 1/s^2 + 1 and J_4 = J_6 = s^2 cos^2 alpha + sin^2 alpha.
inline double hoop_stress_difference(const Material& layer, double s) {
  double difference = 0;
  std::visit([&](const auto& m) { difference = m.shear_modulus() * (s * s - 1 / (s * s)); }, layer);
  if (const auto* artery = std::get_if<Artery>(&layer)) {
    const double c = std::cos(artery->fibre_angle()), hoop = s * s * c * c, e = hoop + 1 - c * c - 1;
    if (e > 0) difference += 2 * 2 * artery->k1 * std::exp(artery->k2 * e * e) * e * hoop;
  }
  return difference;
}

/// Inner pressure of the tube inflated to inner radius a: p = integral of (sigma_theta - sigma_r) / r dr over the wall,
/// with r^2 = R^2 + a^2 - R_i^2, by Gauss's rule of three points on 200 intervals a layer.
inline double inflation_pressure(const Tube& tube, double a) {
  const double k = a * a - inner_radius * inner_radius;
  double p = 0;
  for (const auto& layer : tube.layers) {
    constexpr int intervals = 200;
    const double h = (layer.outer - layer.inner) / intervals;
    for (int i = 0; i < intervals; ++i)
      for (const auto& [x, w] :
           {std::pair{-std::sqrt(0.6), 5.0 / 18}, std::pair{0.0, 8.0 / 18}, std::pair{std::sqrt(0.6), 5.0 / 18}}) {
        const double big_r = layer.inner + h * (i + 0.5 + 0.5 * x), r2 = big_r * big_r + k;
        p += w * h * hoop_stress_difference(layer.material, std::sqrt(r2) / big_r) * big_r / r2;
      }
  }
  return p;
}

/// Closed form of docs/theory.md, section 13.1, for layers without fibres: neo-Hookean and, with c10 + c01 for mu,
/// Mooney-Rivlin ones.
inline double isotropic_inflation_pressure(const Tube& tube, double a) {
  const double k = a * a - inner_radius * inner_radius;
  double p = 0;
  for (const auto& layer : tube.layers) {
    const double mu = std::visit([](const auto& m) { return m.shear_modulus(); }, layer.material);
    const double inner = std::sqrt(layer.inner * layer.inner + k), outer = std::sqrt(layer.outer * layer.outer + k);
    p += mu * (std::log(layer.outer * inner / (layer.inner * outer)) +
               0.5 * k * (1 / (inner * inner) - 1 / (outer * outer)));
  }
  return p;
}

}  // namespace fsi::test
