#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
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

  /// Where processes share the grid out, each has stretches of its points and cells. These are the places of their
  /// first ones and the numbers in the whole grid. Node numbers of cells are those of the whole grid.
  struct Stretch {
    std::uint64_t first_point = 0, points = 0;
    std::uint64_t first_cell = 0, cells = 0;
    bool layered = false;  ///< whether the whole grid has layers
  };
  std::optional<Stretch> stretch{};
};

/// N, points of the whole grid.
inline std::uint64_t point_count(const FieldGrid& grid) {
  return grid.stretch ? grid.stretch->points : grid.points.size();
}
/// Cells of this process.
inline std::uint64_t cells_here(const FieldGrid& grid) {
  return grid.cells.size() / static_cast<std::size_t>(grid.nodes_per_cell);
}
/// M, cells of the whole grid.
inline std::uint64_t cell_count(const FieldGrid& grid) {
  return grid.stretch ? grid.stretch->cells : cells_here(grid);
}
inline bool is_layered(const FieldGrid& grid) {
  return grid.stretch ? grid.stretch->layered : !grid.layer.empty();
}

/// Number of points or cells of the whole grid at which a field has values: N or M.
inline std::uint64_t places_of(const FieldGrid& grid, const FieldDescription& field) {
  return field.of_cells ? cell_count(grid) : point_count(grid);
}
/// The number of them at this process.
inline std::uint64_t places_here(const FieldGrid& grid, const FieldDescription& field) {
  return field.of_cells ? cells_here(grid) : grid.points.size();
}
/// The place of the first of these in the whole grid.
inline std::uint64_t first_place(const FieldGrid& grid, const FieldDescription& field) {
  if (!grid.stretch) return 0;
  return field.of_cells ? grid.stretch->first_cell : grid.stretch->first_point;
}

/// Values by (grid, field): N * components doubles, or M * components for a field of cells, in the order (point or
/// cell, component). Where processes share the grid out, those of this process's stretch.
using FieldValues = std::map<std::pair<std::string, std::string>, std::vector<double>>;

}  // namespace fsi
