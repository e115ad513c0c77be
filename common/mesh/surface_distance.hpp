#pragma once

#include <array>
#include <limits>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// The point of a surface that is nearest to a given one.
struct NearestPoint {
  double distance = std::numeric_limits<double>::infinity();  ///< mm
  Point at{};                                                 ///< mm
  int facet = -1;                                             ///< that it lies on
  std::array<double, 3> weights{};                            ///< of the facet's nodes there, 1 together
};

/// Distances from a surface of triangles, or from a line of edges: an edge (a, b) is the triangle (a, b, b). With a
/// tree of boxes a query costs the logarithm of the number of facets.
class SurfaceDistance {
 public:
  using Facet = std::array<int, 3>;

  /// \param nodes  mm; \param facets  at least one
  SurfaceDistance(std::vector<Point> nodes, std::vector<Facet> facets);

  const std::vector<Facet>& facets() const { return facets_; }

  /// \param guess  a facet that may be near: saves time, and is the one returned of several at equal distance
  NearestPoint nearest(const Point& x, int guess = -1) const;

 private:
  struct Box {
    Point low, high;
    int first = 0, last = 0;    ///< of the facets in it, in the order of order_
    int left = -1, right = -1;  ///< boxes of its two parts
  };

  int add_box(int first, int last);
  NearestPoint on_facet(const Point& x, int facet) const;

  std::vector<Point> nodes_;
  std::vector<Facet> facets_;
  std::vector<int> order_;
  std::vector<Box> boxes_;
};

}  // namespace fsi
