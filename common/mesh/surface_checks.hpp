#pragma once

#include "mesh/checked_mesh.hpp"

namespace fsi {

/// Surface groups that the scene needs, or that are there: each facet bounds a cell of the right volumes, with nothing behind
/// it, and lies in one group only; planes of symmetry are planes.
template <int Dim, int Order>
void check_surfaces(const CheckedMesh<Dim, Order>& checked);

}  // namespace fsi
