#pragma once

#include <array>
#include <string>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// What det J = det dx/d(lambda_1, .., lambda_Dim) does over a quadratic cell, lambda being barycentric coordinates; in
/// mm^Dim, Dim! times what a reference cell of the same lambda has for volume.
struct CellJacobian {
  double least;   ///< smallest value found; within 1 % of the mean above the true minimum where positive
  double mean;    ///< over the reference cell; Dim! times the cell's volume
  Point where;    ///< of `least`, mm
  bool positive;  ///< shown to be so in the whole cell
  double ratio() const { return least / mean; }
};

/// Bounds from the Bernstein form of det J, a polynomial of degree Dim: its coefficients enclose it, the outer ones are
/// its values at the vertices [Johnen2013]. All positive: so is det J. A value at a vertex that is not: the cell is bad.
/// Undecided: the cell is halved in its longest reference edge and asked again, some 20 halvings deep at most; a cell
/// still undecided then touches zero to rounding and counts as bad.
/// \param x  nodes of the cell, mid-edge nodes as mesh/mid_edge_nodes.hpp orders them
template <int Dim>
CellJacobian cell_jacobian(const std::array<Point, nodes_of_simplex(Dim, 2)>& x);

/// Whether the coefficients of the cell as a whole are all positive: then det J is, everywhere. False: ask cell_jacobian(),
/// which takes longer.
template <int Dim>
bool is_surely_positive(const std::array<Point, nodes_of_simplex(Dim, 2)>& x);

/// For messages: how a cell whose Jacobian is not positive fails, and what to do.
std::string bad_curved_cell(const CellJacobian& jacobian);
inline constexpr const char* curved_cell_remedy =
    "mesh finer where the geometry curves, or optimise: Mesh.HighOrderOptimize = 2";

}  // namespace fsi
