#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Gives the elements whose centre lies in a region of the case a volume of their own, NAME/REGION, cut out of that of the
/// layer: what follows takes it for a layer. Of regions that share elements the last has them. Regions with a transition cut
/// nothing.
/// \param remarks  a line for each such volume is added to it
/// \throws InputError for a region in which no element of one of its layers is
template <int Dim, int Order>
void cut_out_regions(const Case& setup, SimplexMesh<Dim, Order>& mesh, std::vector<std::string>& remarks);

}  // namespace fsi
