#include "derived/gradient_recovery.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "derived/gradient_fit.hpp"
#include "derived/surface_shape.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr int most_rings = 4, reduced_rings = 2;
constexpr double worthwhile = 0.5;  // remainder of a larger patch against that of a smaller one

using PointWeights = std::vector<std::array<double, 3>>;

/// Positions of a patch's points relative to the first, in coordinates along the curved boundary if it has a shape.
/// \returns nothing where the patch reaches a centre of curvature
std::optional<std::vector<Point>> positions(const std::vector<PatchPoint>& patch, const SurfaceShape* shape) {
  std::vector<Point> points;
  points.reserve(patch.size());
  for (const auto& point : patch) {
    const Point from_first = point.position - patch[0].position;
    const auto there = shape ? shape->straightened(from_first) : from_first;
    if (!there) return std::nullopt;
    points.push_back(*there);
  }
  return points;
}

constexpr double most_bent = 0.1;  // what straightened coordinates may change of the gradient of X, which is one

/// Makes weights in straightened coordinates exact for linear fields again: the gradient of X is one.
/// \returns false where it was so far from it that these are no coordinates of this patch; the weights are then as before
bool keep_linear_fields(const std::vector<PatchPoint>& patch, const std::vector<int>& axes, PointWeights& weights) {
  const auto dim = static_cast<Eigen::Index>(axes.size());
  Eigen::Matrix3d of_position = Eigen::Matrix3d::Identity();
  of_position.topLeftCorner(dim, dim).setZero();
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (Eigen::Index r = 0; r < dim; ++r)
      for (Eigen::Index c = 0; c < dim; ++c)
        of_position(r, c) += (patch[i].position[axes[r]] - patch[0].position[axes[r]]) * weights[i][c];
  if (!((of_position - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= most_bent)) return false;
  const Eigen::Matrix3d inverse = of_position.inverse();
  for (auto& weight : weights) {
    std::array<double, 3> corrected{0, 0, 0};
    for (Eigen::Index r = 0; r < dim; ++r)
      for (Eigen::Index c = 0; c < dim; ++c) corrected[c] += weight[r] * inverse(r, c);
    weight = corrected;
  }
  return true;
}

/// The nodes of a single cell determine the element's polynomial, unless rounding hides its thickness.
InputError too_flat(const Point& x) {
  return {"", "mesh",
          fmt::format("all cells around the node at ({:.6g}, {:.6g}, {:.6g}) mm are too flat for gradients there", x[0],
                      x[1], x[2]),
          "give fewer layers of cells there, or ask for no shear stress, wall stress, forces, statistics or error "
          "indicator"};
}

/// Finds weights for one node after another.
class WeightSearch {
 public:
  explicit WeightSearch(const RecoveryCells& cells)
      : axes_(cells.axes), patches_(cells), fit_(cells.axes, cells.order) {
    if (cells.along_boundaries) shapes_.emplace(cells);
  }

  /// \returns whether the polynomial has the degree above the element's in all directions
  bool find(int node) {
    if (const SurfaceShape* shape = shapes_ ? shapes_->at(node) : nullptr) {
      const bool full = find_full(node, shape);
      // Else the first ring reaches the centre of curvature, or the shape is not that of the patch.
      if ((full || find_reduced(node, shape)) && keep_linear_fields(patches_.points(), axes_, weights_)) return full;
    }
    const bool full = find_full(node, nullptr);
    if (!full && !find_reduced(node, nullptr)) throw too_flat(patches_.points().front().position);
    return full;
  }
  /// Per point of the patch, for its first points: the patch may have grown since.
  const PointWeights& weights() const { return weights_; }
  const Mat3<double>& error_directions() const { return error_directions_; }
  const RecoveryPatches& patches() const { return patches_; }

 private:
  enum class Growth { determined, undetermined, at_a_centre };
  Growth grow(const SurfaceShape* shape, GradientFit::Frame frame = GradientFit::Frame::of_the_patch) {
    patches_.grow();
    const auto points = positions(patches_.points(), shape);
    if (!points) return Growth::at_a_centre;
    return fit_.set(*points, frame) ? Growth::determined : Growth::undetermined;
  }

  bool find_full(int node, const SurfaceShape* shape) {
    patches_.begin(node);
    std::optional<double> least;
    for (int ring = 0; ring < most_rings; ++ring) {
      const Growth growth = grow(shape);
      if (growth == Growth::at_a_centre) break;
      if (growth == Growth::undetermined || !fit_.solve() ||
          fit_.amplification() > GradientRecovery::largest_amplification)
        continue;
      const double remainder = fit_.remainder();
      if (least && !(remainder < worthwhile * *least)) break;
      least = remainder;
      take();
      if (fit_.amplification() <= GradientRecovery::good_amplification) break;
    }
    return least.has_value();
  }

  bool find_reduced(int node, const SurfaceShape* shape) {
    patches_.begin(node);
    bool found = false;
    for (int ring = 0; ring < most_rings && (ring < reduced_rings || !found); ++ring) {
      const Growth growth = grow(shape, GradientFit::Frame::of_space);
      if (growth == Growth::at_a_centre) break;
      found = growth == Growth::determined;
    }
    if (!found) return false;
    int left_out = 1;
    while (left_out < fit_.directions() &&
           !(fit_.solve(left_out) && fit_.amplification() <= GradientRecovery::largest_amplification))
      ++left_out;
    fit_.solve(left_out);
    take();
    return true;
  }

  void take() {
    weights_ = fit_.weights();
    error_directions_ = {};
    if (fit_.left_out() == 0) return;
    const Eigen::MatrixXd directions = fit_.error_directions();
    for (std::size_t r = 0; r < axes_.size(); ++r)
      for (std::size_t c = 0; c < axes_.size(); ++c)
        error_directions_(axes_[r], axes_[c]) =
            directions(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) / directions.trace();
  }

  std::vector<int> axes_;
  RecoveryPatches patches_;
  std::optional<SurfaceShapes> shapes_;
  GradientFit fit_;
  PointWeights weights_;
  Mat3<double> error_directions_{};
};

}  // namespace

GradientRecovery::GradientRecovery(const RecoveryCells& cells, std::vector<int> at)
    : at_(std::move(at)), axes_(cells.axes), axisymmetric_(cells.axisymmetric) {
  WeightSearch search(cells);
  for (const int node : at_) {
    if (axisymmetric_) radius_.push_back(cells.points[node][0]);
    if (!search.find(node)) ++fallbacks_;
    const auto& weights = search.weights();
    const auto& points = search.patches().points();
    weights_.insert(weights_.end(), weights.begin(), weights.end());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      patch_.push_back(points[i].node);
      turn_.push_back(points[i].image);
    }
    error_directions_.push_back(search.error_directions());
    offsets_.push_back(patch_.size());
  }
  for (int image = 0; image < search.patches().images(); ++image) turns_.push_back(search.patches().turn(image));
  if (search.patches().images() == 1) turn_ = {};
}

void GradientRecovery::restrict_to(const PartRestriction& here) {
  far_.emplace(here, patch_);
  for (int& node : patch_) node = far_->number(here, node);
  for (int& node : at_) node = here.local(node);
}

}  // namespace fsi
