#pragma once

#include <vector>

#include "wall/kelvin_voigt.hpp"
#include "wall/wall_input.hpp"

namespace fsi {

/// The element loops of the layers with a viscosity, beside those of their elastic laws: a wall without such layers has
/// none of them, and its other loops do not know of them.
template <class Element>
struct ViscousLayers {
  static constexpr int n = Element::components;

  /// Adds to the residual and, if there is one, to the Jacobian. Without velocity, in statics, nothing.
  static void add(const std::vector<WallLayer<Element>>& layers, const WallInput& in, std::vector<double>& residual,
                  WallMatrix<n>* jacobian);
  /// Energy that they dissipate in a balance of a step, W (eta dE/dt, dE/dt), uJ; over the elements counted here.
  static double work(const std::vector<WallLayer<Element>>& layers, const WallStep& step);
};

}  // namespace fsi
