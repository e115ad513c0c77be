#pragma once

#include <memory>
#include <vector>

#include "case/case.hpp"
#include "scene/boundary_conditions.hpp"
#include "scene/build_scene.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// The wall shear stress: the traction of the fluid on what it sticks to, without its part along the normal,
///   tau = -(I - n n^T) mu (grad u + grad u^T) n,   n outward from the fluid,
/// in the current configuration, in kPa, along the flow (docs/theory.md, section 11a). At the nodes of the fluid's closed
/// boundary, the interface with the wall included; of a fluid that is shared out, at this process's nodes of it. All
/// processes ask for it together.
template <int n>
class WallShearStress {
 public:
  virtual ~WallShearStress() = default;
  /// Of the fluid, ascending.
  virtual const std::vector<int>& nodes() const = 0;
  /// At these nodes, components in space side by side: 3 numbers each.
  virtual std::vector<double> at_nodes(const Solution& level) const = 0;
};

/// \param mesh   that the scene was built on
/// \param whole  parts of a mesh that is shared out; empty: the scene has them
template <class Element>
std::unique_ptr<WallShearStress<Element::components>> make_wall_shear_stress(const Case& setup,
                                                                             const MeshOf<Element>& mesh,
                                                                             const Scene<Element::components>& scene,
                                                                             const WholeParts<Element>& whole = {});

}  // namespace fsi
