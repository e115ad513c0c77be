#pragma once

#include <vector>

#include "mesh/submesh.hpp"
#include "parallel/communicator.hpp"
#include "wall/wall_deformation.hpp"
#include "wall/wall_input.hpp"

namespace fsi {

/// How far one layer is deformed, of the elements that this process counts: det F at the quadrature points of all, and the
/// sign of det F in the whole of quadratic ones, by the Bernstein form of their Jacobian (mesh/curved_cells.hpp). A pass
/// over gradients alone: what it takes is small beside a residual. The same for any number of threads.
template <class Element>
LayerDeformation layer_deformation(const WallLayer<Element>& layer, const Submesh<Element::dim, Element::order>& part,
                                   const DeformationInput& in);

/// The extremes over all processes, which call it together; of equal ones that of the lowest rank.
std::vector<LayerDeformation> worst_of_all(const std::vector<LayerDeformation>& layers, const Communicator& processes);

}  // namespace fsi
