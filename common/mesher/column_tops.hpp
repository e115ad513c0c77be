#pragma once

#include <array>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesher/offset_distance.hpp"

namespace fsi {

/// Columns of prisms on the facets of a surface, which stand on its nodes and are straight.
struct ColumnGround {
  std::vector<Point> nodes;                ///< mm, that the columns stand on
  std::vector<std::array<int, 3>> facets;  ///< their normals look along the columns
  std::vector<Point> normals;              ///< unit, the columns' first directions
  std::vector<std::vector<Point>>
      planes;                     ///< per node, unit normals of planes that its column lies in: none, one or two
  std::vector<double> thickness;  ///< mm, asked for, per node
  std::vector<double> levels;     ///< heights relative to the top's, ascending, the last one 1
};

/// Where the columns end, mm: as far from the surface as asked for, and so that no prism folds if that is possible.
/// Tops lie along the columns' first directions. Where prisms would fold there or be far worse than upright ones, tops
/// slide along the offset surface, one after the other, to the place where the cells around are best: by the soft
/// minimum of their mean ratios over those of upright prisms, in the manner of [Freitag1997].
std::vector<Point> column_tops(const ColumnGround& ground, const OffsetDistance& offset);

/// Levels of a column, mm, on the line from bottom to top: where the reach (mesher/offset_distance.hpp) is that part of
/// the top's. The last one is the top.
std::vector<Point> column_levels(const Point& bottom, const Point& top, const std::vector<double>& levels,
                                 const OffsetDistance& offset);

}  // namespace fsi
