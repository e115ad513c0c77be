#pragma once

#include <optional>
#include <vector>

#include "scene/boundary_conditions.hpp"

namespace fsi {

/// An opening whose rim slides or is free, so that it moves with the wall (docs/theory.md, section 3.8).
template <int n>
struct MovingOpening {
  std::vector<char> on;             ///< per node of the fluid
  std::vector<Direction<n>> holds;  ///< unit vectors along which the wall is held all along the rim, and so is the mesh
};

/// Of the openings in their order, those with nodes of their rim on the interface where the wall is not held altogether.
/// \param wet  per node of the fluid: on the interface
template <class Element>
std::vector<std::optional<MovingOpening<Element::components>>> moving_openings(
    const MeshOf<Element>& mesh, const PartOf<Element>& fluid,
    const std::vector<OpenBoundary<Element::components>>& open, const std::vector<char>& wet,
    const WallSide<Element>& wall);

/// The conditions of planes of symmetry and of the axis on velocity and mesh with those of moving openings on the mesh,
/// and frames that serve both; at nodes on the interface the wall's frames. In a moving opening the mesh is free but for
/// the directions that the opening holds; where the fluid sticks it is at rest, as fluid_boundary() has said before.
template <class Element>
void hold_with_openings(const MeshOf<Element>& mesh, const PartOf<Element>& fluid,
                        const std::vector<std::optional<MovingOpening<Element::components>>>& moving,
                        const std::vector<char>& wet, const WallSide<Element>& wall, FluidBoundary<Element>& boundary);

/// \throws InputError where the flow of a moving opening is given with another profile than the default: its velocity
/// is an unknown, not given
template <int n>
void require_no_profile_where_openings_move(const Case& setup, const std::vector<OpenBoundary<n>>& open);

}  // namespace fsi
