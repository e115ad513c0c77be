#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fields/field_samples.hpp"

namespace fsi {

/// The shape of a region in space.
struct RegionShape {
  enum class Kind { box, sphere, line, surface };
  Kind kind = Kind::box;
  Point low{0, 0, 0}, high{0, 0, 0};  ///< of a box, mm
  Point centre{0, 0, 0};              ///< of a sphere, mm
  double radius = 0;                  ///< mm
  double within = 0;        ///< of a line or surface: points no farther away than this belong to the region, mm
  double from = 0, to = 0;  ///< of a line: stretch along it that counts, mm from its first point; to 0: its end
  std::shared_ptr<const std::vector<Point>> line;  ///< two points or more
  std::shared_ptr<const PaintedSurface> surface;
};

/// Signed distance of points from a shape.
class RegionDistance {
 public:
  /// \param reach  mm; greater distances may be returned as this one
  RegionDistance(const RegionShape& shape, double reach);
  /// mm outside the shape; negative inside.
  double operator()(const Point& x) const;

 private:
  double to_line(const Point& x) const;
  double to_surface(const Point& x) const;
  void sort_triangles();
  std::size_t box_of(const Point& x) const;

  RegionShape shape_;
  double reach_;  ///< mm, from the surface itself
  Point low_{0, 0, 0};
  double step_ = 1;
  std::array<int, 3> boxes_{1, 1, 1};
  std::vector<std::vector<int>> triangles_;  ///< those nearer than reach_ to a box of a grid
};

}  // namespace fsi
