#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A field of a grid.
struct FieldDescription {
  std::string name;       ///< "displacement", "velocity", "pressure", ...; unique in its grid
  int components = 1;     ///< 1: scalar; 3: vector of space; 6: symmetric tensor xx, xy, xz, yy, yz, zz
  std::string unit;       ///< "mm", "mm/ms", "kPa"
  bool of_cells = false;  ///< one value a cell; else one a node
};

/// One medium's grid. Fluid and wall have nodes of their own, since the pressure jumps between them.
struct FieldGrid {
  std::string name;           ///< "fluid", "wall"
  std::vector<Point> points;  ///< N reference positions, mm
  int nodes_per_cell = 4;     ///< 4 or 10: tetrahedra, 3 or 6: triangles; mid-edge nodes in VTK's order
  std::vector<int> cells;     ///< M * nodes_per_cell node numbers below N
  std::vector<int> layer;     ///< M region numbers, written as the cell field "layer"; or empty
  std::vector<FieldDescription> fields;
};

/// How many nodes or cells of a grid a field has values at: N or M.
inline std::size_t places_of(const FieldGrid& grid, const FieldDescription& field) {
  return field.of_cells ? grid.cells.size() / static_cast<std::size_t>(grid.nodes_per_cell) : grid.points.size();
}

/// Values by (grid, field): N * components doubles, or M * components for a field of cells; the components of a node or
/// cell side by side.
using FieldValues = std::map<std::pair<std::string, std::string>, std::vector<double>>;

}  // namespace fsi
