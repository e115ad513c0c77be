#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Gives the elements whose centre lies in a region of the case a volume of their own, LAYER/REGION, which the scene
/// treats as a layer. Elements in several regions belong to the last. Regions with a transition cut nothing.
/// \param remarks  a line for each such volume is added to it
/// \throws InputError for a region in which no element of one of its layers is, and for a layer or region that later
///         regions leave no element
template <int Dim, int Order>
void cut_out_regions(const Case& setup, SimplexMesh<Dim, Order>& mesh, std::vector<std::string>& remarks);

}  // namespace fsi
