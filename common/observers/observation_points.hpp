#pragma once

#include <string>
#include <utility>
#include <vector>

#include "case/case.hpp"
#include "mesh/submesh.hpp"
#include "observers/observation.hpp"
#include "scene/boundary_conditions.hpp"

namespace fsi {

/// The whole parts of a mesh that a scene has problems on; null where there is none.
template <class Element>
struct VesselParts {
  const PartOf<Element>* fluid = nullptr;
  const PartOf<Element>* wall = nullptr;
};

/// The two openings between which a vessel is a tube: inlet and outlet, or the only two that there are. Empty where there
/// are more or fewer, or where one of them is in several pieces: a vessel that branches.
template <class Element>
std::vector<std::string> tube_openings(const Case& setup, const MeshOf<Element>& mesh);

/// Centre line and wall line of the tables that every run of a straight tube has: along its axis. Where a tube does not
/// follow the axis that its case names, or the vessel is none, both are left out, which `notes` say.
/// \param source  the file that messages about the mesh name
template <class Element>
ObservationPoints observation_points(const Case& setup, const MeshOf<Element>& mesh, const VesselParts<Element>& parts,
                                     const std::string& source);

}  // namespace fsi
