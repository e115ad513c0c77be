#pragma once

#include <cstddef>
#include <vector>

#include "wall/wall_input.hpp"

namespace fsi {

/// What the branches of a step's balance do besides changing the energy; uJ.
struct MaxwellWork {
  double dissipated = 0;  ///< sum of W (2 G_i / tau_i (E - A_i), E - A_i), in the dashpots
  double beyond = 0;      ///< W (F Q, grad v) - omega (stored_1 - stored_0) - dissipated: error of the rule in time
};

/// The element loops of layers with Maxwell branches (wall/maxwell_form.hpp), beside those of their elastic laws: a wall
/// without such layers has none of them. `strains` holds the A_i at the quadrature points, as BranchPlaces says.
template <class Element>
struct MaxwellLayers {
  static constexpr int n = Element::components;
  using Layers = std::vector<WallLayer<Element>>;

  /// Adds to the residual and, if there is one, to the Jacobian. Without velocity, in statics, nothing.
  static void add(const Layers& layers, const BranchPlaces& places, const WallInput& in, std::vector<double>& residual,
                  WallMatrix<n>* jacobian);
  /// Writes the A_i of a balance; without velocity those of branches at rest, E.
  static void settle(const Layers& layers, const BranchPlaces& places, const WallInput& in, double* strains);
  /// In the springs of a level, sum of G_i (E - A_i, E - A_i), uJ.
  static double stored(const Layers& layers, const BranchPlaces& places, const WallInput& level, const double* strains);
  static MaxwellWork work(const Layers& layers, const BranchPlaces& places, const WallStep& step);
};

}  // namespace fsi
