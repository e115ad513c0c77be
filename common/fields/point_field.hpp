#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fields/field_samples.hpp"
#include "fields/near_points.hpp"
#include "mesh/cell_grid.hpp"

namespace fsi {

/// A field of a file at any place: linear in the cell that holds the place, or that cell's value, where the file has
/// tetrahedra, or triangles in the plane of a mesh of triangles. Elsewhere a field of points is, by its twelve nearest points, the
/// linear function of least squares with weights 1/distance^2, kept within the range of their values; a field of cells that of
/// the nearest cell's centre. Directions in which the points do not spread count for nothing: along the normal of a surface
/// the field does not change.
class PointField {
 public:
  /// \param samples  one or more, of finite values
  /// \param within   how far a place outside all cells may be from the nearest of the samples, mm; 0: three times the
  ///                 median of their distances from each other
  PointField(FieldSamples samples, double within);

  double within() const { return within_; }
  /// At a place; nothing in a hole, farther than within() from all samples.
  std::optional<double> at(const Point& x) const;
  /// From the nearest sample, mm.
  double distance_to(const Point& x) const;

 private:
  template <int Dim>
  struct Cells {
    SimplexMesh<Dim> mesh;
    std::vector<int> places;  ///< of a field of cells
    std::optional<CellGrid> grid;
    std::optional<double> at(const Point& x, const std::vector<double>& values) const;
  };
  void keep_cells(FieldSamples& samples);
  double fitted(const Point& x) const;

  NearPoints points_;
  std::vector<double> values_;
  bool of_cells_;
  double within_ = 0;
  Cells<3> tetrahedra_;
  Cells<2> triangles_;
};

/// A distance from each of the points to the next, mm, of which half are smaller: asked of a thousand at most.
double median_spacing(const NearPoints& points);

}  // namespace fsi
