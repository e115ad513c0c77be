#pragma once

#include <memory>
#include <vector>

#include "case/case.hpp"
#include "scene/boundary_conditions.hpp"
#include "scene/build_scene.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// The wall shear stress: the traction of the fluid on no-slip surfaces, without its part along the normal,
///   tau = -(I - n n^T) mu (grad u + grad u^T) n,   n outward from the fluid,
/// in the current configuration, in kPa, along the flow (docs/theory.md, section 11a.2). At the nodes of the fluid's
/// closed boundary, the interface with the wall included, that this process owns.
template <int n>
class WallShearStress {
 public:
  virtual ~WallShearStress() = default;
  /// Numbers of these nodes in the fluid, ascending.
  virtual const std::vector<int>& nodes() const = 0;
  /// At these nodes, 3 components in space each, kPa. Collective over the processes that share the fluid.
  virtual std::vector<double> at_nodes(const Solution& level) const = 0;
};

/// \param mesh   that the scene was built on
/// \param scene  has a fluid; must outlive what is made
/// \param whole  whole parts of a mesh that processes share; empty: the scene has them
template <class Element>
std::unique_ptr<WallShearStress<Element::components>> make_wall_shear_stress(const Case& setup,
                                                                             const MeshOf<Element>& mesh,
                                                                             const Scene<Element::components>& scene,
                                                                             const WholeParts<Element>& whole = {});

}  // namespace fsi
