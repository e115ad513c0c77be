#include "sampling/smooth_curve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "fem/simplex_rule.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

SmoothCurve::SmoothCurve(std::vector<Point> points) : points_(std::move(points)), slopes_(points_.size()) {
  const std::size_t last = points_.size() - 1;
  assert(points_.size() >= 2);
  std::vector<Point> secant;
  for (std::size_t i = 0; i < last; ++i) {
    chord_.push_back(distance(points_[i + 1], points_[i]));
    secant.push_back((1 / chord_[i]) * (points_[i + 1] - points_[i]));
  }
  for (std::size_t i = 1; i < last; ++i)
    slopes_[i] = (1 / (chord_[i - 1] + chord_[i])) * (chord_[i] * secant[i - 1] + chord_[i - 1] * secant[i]);
  slopes_[0] = last == 1 ? secant[0] : 2 * secant[0] - slopes_[1];
  slopes_[last] = last == 1 ? secant[0] : 2 * secant[last - 1] - slopes_[last - 1];
  reached_.push_back(0);
  for (std::size_t i = 0; i < last; ++i) reached_.push_back(reached_[i] + length_to(i, 1));
}

Point SmoothCurve::in_piece(std::size_t i, double t) const {
  const double u = 1 - t;
  return (u * u * (1 + 2 * t)) * points_[i] + (t * t * (1 + 2 * u)) * points_[i + 1] +
         (chord_[i] * t * u) * (u * slopes_[i] - t * slopes_[i + 1]);
}

double SmoothCurve::speed(std::size_t i, double t) const {
  const Point change = (6 * t * (1 - t)) * (points_[i + 1] - points_[i]) +
                       chord_[i] * ((1 - t) * (1 - 3 * t) * slopes_[i] + t * (3 * t - 2) * slopes_[i + 1]);
  return norm(change);
}

double SmoothCurve::length_to(std::size_t i, double t) const {
  static constexpr auto rule = line_rule_7();
  double sum = 0;
  for (int q = 0; q < rule.points; ++q) sum += rule.weight[q] * speed(i, t * rule.point[q][0]);
  return t * sum;
}

Point SmoothCurve::at(double s) const {
  if (s <= 0) return points_.front();
  if (s >= length()) return points_.back();
  const auto behind = std::upper_bound(reached_.begin(), reached_.end(), s);
  const auto piece = std::min(static_cast<std::size_t>(behind - reached_.begin()), points_.size() - 1) - 1;
  const double wanted = s - reached_[piece], whole = reached_[piece + 1] - reached_[piece];
  double t = wanted / whole;
  for (int step = 0; step < 20; ++step) {  // Newton's method; speeds are near that of the chord
    const double change = (wanted - length_to(piece, t)) / speed(piece, t);
    if (!std::isfinite(change)) break;
    t = std::clamp(t + change, 0.0, 1.0);
    if (std::abs(change) < 1e-14) break;
  }
  return in_piece(piece, t);
}

}  // namespace fsi
