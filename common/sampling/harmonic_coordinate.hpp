#pragma once

#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// The solution of Laplace's equation with linear elements between the vertices of cells: 0 on some nodes, 1 on others,
/// no flux through the rest of the boundary. From one opening of a tube to another it rises along the tube whatever way
/// that takes, and is constant across it where neither bend nor section change. Conjugate gradients around a multigrid
/// cycle; the same bits on any number of threads.
/// \param nodes     positions, mm
/// \param vertices  Dim + 1 for each cell in turn
/// \param low       nodes where it is 0
/// \param high      nodes where it is 1
/// \param turned    whether triangles stand for a body of revolution, x being the radius
/// \returns per node; 0 at nodes that are no vertex. Where cells do not connect the two it is 0 or 1 throughout
/// \throws ConvergenceError when conjugate gradients do not converge, as with badly shaped cells
template <int Dim>
std::vector<double> harmonic_coordinate(const std::vector<Point>& nodes, const std::vector<int>& vertices,
                                        const std::vector<int>& low, const std::vector<int>& high, bool turned = false);

}  // namespace fsi
