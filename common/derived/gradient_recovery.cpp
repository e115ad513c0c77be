#include "derived/gradient_recovery.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "derived/gradient_fit.hpp"

namespace fsi {

namespace {

constexpr int most_rings = 4, reduced_rings = 2;
constexpr double worthwhile = 0.5;  // remainder of a larger patch against that of a smaller one

std::vector<Point> positions(const std::vector<PatchPoint>& patch) {
  std::vector<Point> points;
  points.reserve(patch.size());
  for (const auto& point : patch) points.push_back(point.position);
  return points;
}

}  // namespace

GradientRecovery::GradientRecovery(const RecoveryCells& cells, std::vector<int> at)
    : at_(std::move(at)), axes_(cells.axes), axisymmetric_(cells.axisymmetric) {
  RecoveryPatches patches(cells);
  GradientFit fit(cells.axes, cells.order);
  const auto grow = [&](GradientFit::Frame frame = GradientFit::Frame::of_the_patch) {
    patches.grow();
    return fit.set(positions(patches.points()), frame);
  };
  for (const int node : at_) {
    if (axisymmetric_) radius_.push_back(cells.points[node][0]);
    patches.begin(node);
    std::optional<double> least;
    std::vector<std::array<double, 3>> weights;
    for (int ring = 0; ring < most_rings; ++ring) {
      if (!grow() || !fit.solve() || fit.amplification() > largest_amplification) continue;
      if (const double remainder = fit.remainder(); !least || remainder < worthwhile * *least) {
        least = remainder;
        weights = fit.weights();
      } else {
        break;
      }
      if (fit.amplification() <= good_amplification) break;
    }
    if (!least) {
      ++fallbacks_;
      patches.begin(node);
      bool found = false;
      for (int ring = 0; ring < most_rings && (ring < reduced_rings || !found); ++ring)
        found = grow(GradientFit::Frame::of_space);
      assert(found && "the nodes of a single cell determine the element's polynomial");
      int left_out = 1;
      while (left_out < fit.directions() && !(fit.solve(left_out) && fit.amplification() <= largest_amplification))
        ++left_out;
      fit.solve(left_out);
      weights = fit.weights();
    }
    weights_.insert(weights_.end(), weights.begin(), weights.end());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      patch_.push_back(patches.points()[i].node);
      turn_.push_back(patches.points()[i].image);
    }
    offsets_.push_back(patch_.size());
  }
  for (int image = 0; image < patches.images(); ++image) turns_.push_back(patches.turn(image));
  if (patches.images() == 1) turn_ = {};
}

void GradientRecovery::restrict_to(const PartRestriction& here) {
  far_.emplace(here, patch_);
  for (int& node : patch_) node = far_->number(here, node);
  for (int& node : at_) node = here.local(node);
}

}  // namespace fsi
