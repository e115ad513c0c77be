#pragma once

#include <cmath>

#include "scene/scene.hpp"

namespace fsi {

/// Speed c_w of long pressure waves in a tube with the scene's fluid and wall, mm/ms: that of Moens and Korteweg with a
/// layered wall held along its axis,
///   c_w^2 = sum over layers E_k h_k / (1 - nu_k^2) / (2 rho R),
/// fibres and springs of Maxwell branches counted in E_k. With h_k = V_k / A and R = 2 V_f / A, A the interface's area,
/// A cancels. An estimate where the scene is no tube.
template <int n>
double wave_speed(const Scene<n>& scene) {
  double stiffness = 0;  // kPa mm^3
  for (const auto& layer : scene.wall->layer_data())
    stiffness += layer.sudden_hoop_modulus(scene.wall->constants().bulk_modulus) * layer.volume;
  return std::sqrt(stiffness / (4 * scene.fluid->form().density * scene.fluid->volume()));
}

/// Lets the stabilisation of both media know how fast pressure travels in the scene.
template <int n>
void stabilise_for_waves(Scene<n>& scene) {
  const double speed = wave_speed(scene);
  scene.fluid->set_wave_speed(speed);
  scene.wall->set_wave_speed(speed);
}

}  // namespace fsi
