#pragma once

#include <vector>

#include "scene/boundary_conditions.hpp"

namespace fsi {

/// What a facet of a wall's boundary is by its name, or by what lies behind it.
enum class WallFacetKind {
  inner,     ///< the interface with the fluid, else the group `inner`
  end,       ///< of the group `wall_ends`
  symmetry,  ///< on a plane of symmetry
  axis,      ///< on the axis of a body of revolution
  other      ///< all else
};

/// A facet of a wall's boundary.
template <class Element>
struct WallFacet {
  typename MeshOf<Element>::Facet nodes;  ///< of the whole mesh, oriented out of the wall
  Point normal;                           ///< of its vertices' plane, out of the wall, unit length
  WallFacetKind kind;
  int plane = -1;  ///< number of the plane of symmetry
  int body = 0;    ///< number of the connected piece of wall that it bounds
};

template <class Element>
using WallFacets = std::vector<WallFacet<Element>>;

/// The boundary of the union of these regions, layers together.
template <class Element>
WallFacets<Element> wall_boundary(const MeshOf<Element>& mesh, const std::vector<int>& wall_regions);

}  // namespace fsi
