#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A nodal field of a grid.
struct FieldDescription {
  std::string name;    ///< "displacement", "velocity", "pressure", ...
  int components = 1;  ///< 1: scalar; 3: vector of space; 6: symmetric tensor xx, xy, xz, yy, yz, zz
  std::string unit;    ///< "mm", "mm/ms", "kPa"
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

/// Nodal values by (grid, field): N * components doubles, the components of a node side by side.
using FieldValues = std::map<std::pair<std::string, std::string>, std::vector<double>>;

}  // namespace fsi
