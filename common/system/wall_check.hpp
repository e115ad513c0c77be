#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace fsi {

/// How far a wall is deformed, and whether that can be.
struct WallCheck {
  std::vector<LayerDeformation> layers;  ///< in the order of Wall::layer_data(); empty: the scene has no wall
  std::string fault;                     ///< why this is no solution, a clause with the place; empty: it may be one
};

/// Looks at a displacement of the wall, of a level or, while the wall looks for its unloaded shape, of the search
/// (docs/theory.md, section 4.9). It is no solution where
///   - det F is not positive: at a quadrature point, or anywhere in a quadratic element;
///   - det F of a nearly incompressible layer is beyond f or below 1/f at a quadrature point, f = Scene::volume_factor.
/// Processes that share the scene ask together, and are told the same.
template <int n>
WallCheck check_wall(const Scene<n>& scene, const std::vector<double>& wall);

/// What to try where it is none.
template <int n>
std::string wall_check_remedy(const Scene<n>& scene) {
  return std::string(scene.is_static() ? "more static.load_steps" : "a smaller time.step") +
         ", a smaller load, or a finer mesh at that place";
}

/// Whether the law measures its change of volume by J - 1 and resists it so much more than shear that det F stays near one:
/// kappa of 20 times mu at least, a Poisson's ratio of 0.475.
/// \param of_structure  bulk modulus of layers without one, kPa
bool is_nearly_incompressible(const Material& material, double of_structure);

}  // namespace fsi
