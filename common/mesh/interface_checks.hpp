#pragma once

#include "mesh/checked_mesh.hpp"

namespace fsi {

/// Of a scene of fluid and wall: they share facets, meet nowhere without sharing nodes, and what bounds the interface is
/// clamped, in a plane of symmetry, on the axis or free in an opening.
template <int Dim, int Order>
void check_interface(const CheckedMesh<Dim, Order>& checked);

}  // namespace fsi
