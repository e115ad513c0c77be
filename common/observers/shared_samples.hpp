#pragma once

#include "mesh/mesh_share.hpp"
#include "observers/observation.hpp"

namespace fsi {

/// What a process has of the samples of a medium that is shared out. The sum over the processes of what theirs give is
/// what the sample gives.
/// \param sample  in numbers of the whole part
/// \returns the entries of own nodes, in numbers here
NodalSample restricted(const NodalSample& sample, const PartRestriction& here);

/// Makes samples on whole parts those of this process, but for planes.
/// \param fluid, wall  of the media; null where there is none
void restrict_samples(const PartRestriction* fluid, const PartRestriction* wall, ObservationPoints& points);

/// Has planes cut this part of the fluid, its share or all of it, in place of the one that they were made of, which they no
/// longer look at. \param fluid  must outlive the points
void cut_through(const PartNodes& fluid, ObservationPoints& points);

}  // namespace fsi
