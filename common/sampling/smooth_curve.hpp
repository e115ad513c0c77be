#pragma once

#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A smooth curve through points, parametrised by the length of the chords: cubic between two of them, its slope at
/// each that of the parabola through it and its neighbours. Its error is of third order in the points' distance, on a
/// circle of fourth order but at the ends.
class SmoothCurve {
 public:
  /// \param points  mm, at least two, neighbours different
  explicit SmoothCurve(std::vector<Point> points);

  double length() const { return reached_.back(); }  ///< mm
  /// The point at arc length s from the first one, mm; beyond the curve its first or last point.
  Point at(double s) const;

 private:
  Point in_piece(std::size_t piece, double t) const;
  double speed(std::size_t piece, double t) const;
  /// Arc length from the beginning of a piece to t.
  double length_to(std::size_t piece, double t) const;

  std::vector<Point> points_, slopes_;
  std::vector<double> chord_;    ///< of each piece
  std::vector<double> reached_;  ///< arc length at each point
};

}  // namespace fsi
