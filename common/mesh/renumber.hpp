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
/// path (the pseudo-peripheral node of [George1979]); cells by their smallest new node. In quadratic meshes the
/// vertices are ordered so; a mid-edge node comes before the later of its two vertices. Keeps matrix rows of neighbours
/// close in memory. Depends on nothing but the mesh: ties go by old index.
template <int Dim, int Order>
Renumbering reverse_cuthill_mckee(const SimplexMesh<Dim, Order>& mesh);

/// The mesh in the new order. Nodes within a cell keep their places, so orientation and facet order stay.
template <int Dim, int Order>
SimplexMesh<Dim, Order> renumbered(const SimplexMesh<Dim, Order>& mesh, const Renumbering& order);

/// The inverse of a permutation: new_to_old to old_to_new and back.
std::vector<int> inverse_permutation(const std::vector<int>& permutation);

/// Largest distance between the numbers of two nodes of one cell.
template <int Dim, int Order>
int bandwidth(const SimplexMesh<Dim, Order>& mesh);

}  // namespace fsi
