#pragma once

#include "mesh/mesh_share.hpp"
#include "observers/observation.hpp"

namespace fsi {

/// What a process has of the samples of a medium that is shared out. The sum over the processes of what theirs give is
/// what the sample gives.
/// \param sample  in numbers of the whole part
/// \returns the entries of own nodes, in numbers here
NodalSample restricted(const NodalSample& sample, const PartRestriction& here);

/// Makes samples on whole parts those of this process.
/// \param fluid, wall  of the media; null where there is none
/// \param fluid_nodes  the fluid's part here, which must outlive the points; null without fluid
void restrict_samples(const PartRestriction* fluid, const PartRestriction* wall, const PartNodes* fluid_nodes,
                      ObservationPoints& points);

}  // namespace fsi
