#pragma once

#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A new order of nodes and cells; entry i is the old index of what becomes number i.
struct Renumbering {
  std::vector<int> node_new_to_old;
  std::vector<int> cell_new_to_old;
};

/// Reverse Cuthill-McKee order of the nodes [Cuthill1969], each connected part started from a node at the end of a long
/// path (the pseudo-peripheral node of [George1979]); cells by their smallest new node.
/// Keeps matrix rows of neighbours close in memory. Depends on nothing but the mesh: ties go by old index.
Renumbering reverse_cuthill_mckee(const TetrahedralMesh& mesh);

/// The mesh in the new order. Nodes within a cell keep their places, so orientation and facet order stay.
TetrahedralMesh renumbered(const TetrahedralMesh& mesh, const Renumbering& order);

/// The inverse of a permutation: new_to_old to old_to_new and back.
std::vector<int> inverse_permutation(const std::vector<int>& permutation);

/// Largest distance between the numbers of two nodes of one cell.
int bandwidth(const TetrahedralMesh& mesh);

}  // namespace fsi
