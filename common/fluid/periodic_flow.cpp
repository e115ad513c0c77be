#include "fluid/periodic_flow.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace fsi {

namespace {

struct Piece {
  double from, to;     ///< ms
  double first, last;  ///< mm^3/ms
};

/// The pieces of a period, from the first point on.
template <class Visit>
void for_each_piece(const PeriodicFlow& flow, Visit visit) {
  const auto& points = flow.points;
  assert(flow.period > 0 && !points.empty());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool inside = i + 1 < points.size();
    const Piece piece{points[i].first, inside ? points[i + 1].first : points[0].first + flow.period, points[i].second,
                      inside ? points[i + 1].second : points[0].second};
    if (piece.to > piece.from) visit(piece);
  }
}

}  // namespace

double PeriodicFlow::at(double time) const {
  const double first = points.front().first;
  double t = first + std::fmod(time - first, period);
  if (t < first) t += period;
  double value = points.back().second;
  for_each_piece(*this, [&](const Piece& p) {
    if (t >= p.from && t < p.to) value = p.first + (p.last - p.first) * (t - p.from) / (p.to - p.from);
  });
  return value;
}

std::complex<double> PeriodicFlow::coefficient(int k) const {
  using Complex = std::complex<double>;
  Complex sum = 0;
  const double w = 2 * std::acos(-1.0) * k / period;
  for_each_piece(*this, [&](const Piece& p) {
    if (k == 0) {
      sum += 0.5 * (p.first + p.last) * (p.to - p.from);
      return;
    }
    // Integral of Q e^(-i w t): (i/w Q + Q'/w^2) e^(-i w t) between the ends.
    const double slope = (p.last - p.first) / (p.to - p.from) / (w * w);
    sum += Complex(slope, p.last / w) * std::polar(1.0, -w * p.to) -
           Complex(slope, p.first / w) * std::polar(1.0, -w * p.from);
  });
  return (k == 0 ? 1.0 : 2.0) / period * sum;
}

double PeriodicFlow::mean_square() const {
  double sum = 0;
  for_each_piece(*this, [&](const Piece& p) {
    sum += (p.first * p.first + p.first * p.last + p.last * p.last) / 3 * (p.to - p.from);
  });
  return sum / period;
}

}  // namespace fsi
