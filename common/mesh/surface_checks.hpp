#pragma once

#include "mesh/checked_mesh.hpp"

namespace fsi {

/// Checks the surface groups that the scene needs, or that are there: each facet bounds a cell of the right volumes,
/// with nothing behind it; openings share no facet with each other or with planes of symmetry; these are planes; an
/// axis of quadratic sides is straight. \throws InputError
template <int Dim, int Order>
void check_surfaces(const CheckedMesh<Dim, Order>& checked);

}  // namespace fsi
