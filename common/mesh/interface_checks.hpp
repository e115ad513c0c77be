#pragma once

#include "mesh/checked_mesh.hpp"

namespace fsi {

/// Checks a scene of fluid and wall: they share facets, meet nowhere without sharing nodes, and the interface's rim is
/// clamped, in a plane of symmetry, on the axis or free at an opening. \throws InputError
template <int Dim, int Order>
void check_interface(const CheckedMesh<Dim, Order>& checked);

}  // namespace fsi
