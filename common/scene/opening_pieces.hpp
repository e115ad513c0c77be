#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Openings that are no single opening (mesh/surface_pieces.hpp). A flow that is given, a law, the network and every table
/// take all facets of an opening together: the flow of all, one mean pressure.
/// \param notices  warnings: what leans away from the plane of an opening, pieces with one flow or one law
/// \param remarks  lines for the log: pieces under a pressure, whose tables show sums and means of all
template <int Dim, int Order>
void note_opening_pieces(const Case& setup, const SimplexMesh<Dim, Order>& mesh, std::vector<std::string>& notices,
                         std::vector<std::string>& remarks);

}  // namespace fsi
