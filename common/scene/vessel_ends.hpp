#pragma once

#include <string>
#include <vector>

#include "scene/wall_boundary.hpp"

namespace fsi {

/// The parts of a wall's boundary as of a vessel.
template <class Element>
struct VesselFaces {
  FacetsOf<Element> inner, outer;
  FacetsOf<Element> ends;  ///< of three dimensions alone
  std::string unclear;     ///< a clause about faces that may be ends or cuts along the vessel; empty: there are none
};

/// Tells ends, and cuts along the vessel, from the outer face. Names come first: `wall_ends` are ends. Then shape: a face
/// is what facets make up that meet at less than 30 degrees.
/// - A face without a name that meets the inner one at an edge is no outer face. It is a cut if it touches an end by name,
///   else an end, unless it touches another such face: then it may be either.
/// - A plane of symmetry that touches an end is a cut along the vessel. One that touches none and no other such plane is a
///   cut across it: an end.
template <class Element>
VesselFaces<Element> vessel_faces(const MeshOf<Element>& mesh, const WallFacets<Element>& boundary);

}  // namespace fsi
