#pragma once

#include <string>
#include <utility>
#include <vector>

#include "case/case.hpp"
#include "mesh/submesh.hpp"
#include "observers/observation.hpp"
#include "scene/boundary_conditions.hpp"

namespace fsi {

/// The whole fluid and wall of a mesh; null where a scene has none.
template <class Element>
struct VesselParts {
  const PartOf<Element>* fluid = nullptr;
  const PartOf<Element>* wall = nullptr;
};

/// The surfaces of the two openings between which a vessel is a tube, `inlet` first or `outlet` last. Empty where there
/// are more or fewer openings, or where one of them is in several pieces: the vessel branches.
template <class Element>
std::vector<std::string> tube_openings(const Case& setup, const MeshOf<Element>& mesh);

/// Centre line and wall line of the tables that every run of a straight tube has: along its axis. Both are left out
/// where a tube does not follow the axis that its case names, or the vessel is none; `notes` say so of the wall line,
/// requested_samples() of the centre line.
/// \param source  name of the mesh's file for messages
template <class Element>
ObservationPoints observation_points(const Case& setup, const MeshOf<Element>& mesh, const VesselParts<Element>& parts,
                                     const std::string& source);

}  // namespace fsi
