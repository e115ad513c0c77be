#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace fsi {

/// How far a wall is deformed, and whether that is admissible.
struct WallCheck {
  std::vector<LayerDeformation> layers;  ///< in the order of Wall::layer_data(); empty: the scene has no wall
  std::string fault;                     ///< why it is not admissible, a clause with the place; empty: it is
};

/// Checks a displacement of the wall, of a level or of the search for its unloaded shape (docs/theory.md, section 4.9).
/// It is not admissible where
///   - det F is not positive: at a quadrature point, or anywhere in a quadratic element;
///   - det F of a nearly incompressible layer is beyond f or below 1/f at a quadrature point, f = Scene::volume_factor.
/// Processes that share the scene call it together and get the same result.
template <int n>
WallCheck check_wall(const Scene<n>& scene, const std::vector<double>& wall);

/// What to try after a fault.
template <int n>
std::string wall_check_remedy(const Scene<n>& scene) {
  return std::string(scene.is_static() ? "more static.load_steps" : "a smaller time.step") +
         ", a smaller load, or a finer mesh at that place";
}

/// Whether the law measures its change of volume by J - 1, with kappa of 20 mu at least (a Poisson's ratio of 0.475),
/// so that det F stays near one.
/// \param of_structure  bulk modulus of layers without one, kPa
bool is_nearly_incompressible(const Material& material, double of_structure);

}  // namespace fsi
