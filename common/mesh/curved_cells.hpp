#pragma once

#include <array>
#include <string>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// det J = det dx/d(lambda_1, .., lambda_Dim) over a quadratic cell, mm^Dim; lambda are barycentric coordinates.
struct CellJacobian {
  double least;   ///< smallest value found; if positive, at most 1 % of the mean above the true minimum
  double mean;    ///< over the reference cell; Dim! times the cell's volume
  Point where;    ///< of `least`, mm
  bool positive;  ///< shown to be so in the whole cell
  double ratio() const { return least / mean; }
};

/// Bounds from the Bernstein form of det J, a polynomial of degree Dim: its coefficients enclose it, the outer ones are
/// its values at the vertices [Johnen2013]. If all are positive, so is det J; if one at a vertex is not, the cell is
/// bad. Otherwise the cell is halved at its longest reference edge, and so on, 20 halvings deep and into 4000 parts at
/// most. What is undecided then counts as bad, and `least` is less accurate.
/// \param x  nodes of the cell, mid-edge nodes as mesh/mid_edge_nodes.hpp orders them
template <int Dim>
CellJacobian cell_jacobian(const std::array<Point, nodes_of_simplex(Dim, 2)>& x);

/// Whether all coefficients of the undivided cell are positive, and so det J everywhere. If not, cell_jacobian()
/// decides, which takes longer.
template <int Dim>
bool is_surely_positive(const std::array<Point, nodes_of_simplex(Dim, 2)>& x);

/// For messages: how a cell whose Jacobian is not positive fails, and what to do.
std::string bad_curved_cell(const CellJacobian& jacobian);
inline constexpr const char* curved_cell_remedy =
    "mesh finer where the geometry curves, or optimise: Mesh.HighOrderOptimize = 2";

}  // namespace fsi
