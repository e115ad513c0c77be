#pragma once

#include <optional>
#include <vector>

#include "fem/nodal_layout.hpp"
#include "mesh/submesh.hpp"
#include "scene/dirichlet_conditions.hpp"

namespace fsi {

/// Pressures of the fluid that the Taylor-Hood element leaves without an equation: together they stand beside fewer free
/// velocities than they are themselves, so that the discrete gradient, and with it the system, is singular.
struct LostPressures {
  Point at;            ///< of one of them, mm
  int pressures = 0;   ///< how many
  int velocities = 0;  ///< free components at all nodes of their cells
  int cells = 0;       ///< around them
  bool corner() const { return pressures == 1 && velocities == 0; }
};

/// Beginning of the remark of a scene that tells where the velocity on the interface, if it is given, leaves a pressure
/// without an equation. Drivers that solve both media at once may ignore it.
inline constexpr const char* interface_takes_equations = "if the fluid is given its velocity on the wall,";

/// Finds such pressures by a maximum matching of pressures with free components of the velocity of the same cells
/// [Hall1935]: where a pressure finds no partner, its alternating paths reach a set as above. Each set found makes the
/// system singular; a system that is singular by its values alone, not by its pattern, is not found. Empty for elements
/// with stabilisation.
/// \param velocity  conditions of the fluid's velocity
/// \param given     nodes where the velocity is given besides, as that of an interface; may be empty
template <class Element>
std::optional<LostPressures> lost_pressures(const Submesh<Element::dim, Element::order>& fluid,
                                            const DirichletConditions<Element::components>& velocity,
                                            const std::vector<int>& given = {});

}  // namespace fsi
