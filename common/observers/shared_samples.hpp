#pragma once

#include "mesh/mesh_share.hpp"
#include "observers/observation.hpp"

namespace fsi {

/// A process's part of a sample in a medium that processes share. The sum of the parts' values is the sample's value.
/// \param sample  in numbers of the whole part
/// \returns the entries of own nodes, with node numbers here
NodalSample restricted(const NodalSample& sample, const PartRestriction& here);

/// Restricts all samples but planes to this process, see restricted().
/// \param fluid, wall  of the media; null where there is none
void restrict_samples(const PartRestriction* fluid, const PartRestriction* wall, ObservationPoints& points);

/// Makes planes cut this copy of the fluid, or this process's share, in place of the part that they were made on, which
/// they no longer need. \param fluid  must outlive the points
void cut_through(const PartNodes& fluid, ObservationPoints& points);

}  // namespace fsi
