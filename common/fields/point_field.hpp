#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fields/field_samples.hpp"
#include "fields/near_points.hpp"
#include "mesh/cell_grid.hpp"

namespace fsi {

/// A field of a file at any place: linear in the cell that holds the place, or that cell's value, where the file has
/// tetrahedra, or triangles in the plane of a mesh of triangles. Elsewhere a field of points is the linear function of
/// least squares through the twelve nearest points, weights 1/distance^2, clamped to the range of their values; a field
/// of cells has the value of the nearest cell's centre. The function does not change in directions in which the points
/// do not spread, as along the normal of a surface.
class PointField {
 public:
  /// \param samples  one or more, of finite values
  /// \param within   how far a place outside all cells may be from the nearest of the samples, mm; 0: three times their
  ///                 median_spacing()
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

/// Median distance from a point to the nearest other one, mm, of about a thousand points at most.
double median_spacing(const NearPoints& points);

}  // namespace fsi
