#include "mesher/surface/taubin_smoothing.hpp"

#include <cmath>

#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double towards = 0.5;

TriangleSurface smoothed(TriangleSurface surface, const std::vector<std::vector<int>>& neighbours, int passes,
                         double away) {
  std::vector<Point> moved(surface.nodes.size());
  for (int pass = 0; pass < passes; ++pass)
    for (const double step : {towards, -away}) {
      for (std::size_t i = 0; i < surface.nodes.size(); ++i) {
        Point sum{0, 0, 0};
        for (const int next : neighbours[i]) sum = sum + (surface.nodes[next] - surface.nodes[i]);
        moved[i] = surface.nodes[i] + (step / static_cast<double>(neighbours[i].size())) * sum;
      }
      surface.nodes.swap(moved);
    }
  return surface;
}

}  // namespace

void taubin_smooth(TriangleSurface& surface, int passes) {
  constexpr double kept = 1e-4;  // of the volume
  constexpr int trials = 12;
  const auto neighbours = neighbours_of(surface);
  const double before = enclosed_volume(surface);
  // More away from the mean makes the volume larger.
  double least = towards, most = 1.2 * towards;
  TriangleSurface best;
  for (int trial = 0; trial < trials; ++trial) {
    const double away = 0.5 * (least + most);
    best = smoothed(surface, neighbours, passes, away);
    const double change = enclosed_volume(best) / before - 1;
    if (std::abs(change) < kept) break;
    (change > 0 ? most : least) = away;
  }
  surface = std::move(best);
}

}  // namespace fsi
