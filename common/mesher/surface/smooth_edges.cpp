#include "mesher/surface/smooth_edges.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "mesh/disjoint_sets.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/point_math.hpp"
#include "mesh/smooth_surface.hpp"

namespace fsi {

namespace {

using Facet = TetrahedralMesh::Facet;
using Edge = std::pair<int, int>;

constexpr double least_curved = 1e-3;  // of the edge

Point unit(const Point& v) {
  return (1 / std::max(norm(v), 1e-300)) * v;
}

/// The quadric z = d x + e y + (a x^2 + 2 b x y + c y^2 + k z^2) / 2 through points around the origin
/// (smooth_edges.hpp): slopes d, e and curvatures by least squares, k given.
class QuadricFit {
 public:
  /// \param points  mm
  explicit QuadricFit(const std::vector<Point>& points)
      : matrix_(static_cast<Eigen::Index>(points.size()), unknowns), heights_(matrix_.rows()) {
    double square = 0;
    for (const Point& y : points) square += dot(y, y) / static_cast<double>(points.size());
    for (const Point& y : points) points_.push_back((1 / std::sqrt(square)) * y);
    solver_.setThreshold(dependent_column);
  }

  /// The residual (d, e, k(a, b, c) - k); lengths relative to the points' root mean square.
  Eigen::Vector3d operator()(const Point& normal, const Point& first, const Point& second, double k) {
    for (Eigen::Index i = 0; i < matrix_.rows(); ++i) {
      const Point& y = points_[static_cast<std::size_t>(i)];
      const double u = dot(y, first), v = dot(y, second), z = dot(y, normal);
      const double weight = std::pow(dot(y, y) + nearby, -2);
      matrix_.row(i) << u, v, 0.5 * u * u, u * v, 0.5 * v * v;
      matrix_.row(i) *= weight;
      heights_[i] = weight * (z - 0.5 * k * z * z);
    }
    const Eigen::VectorXd fit = solver_.compute(matrix_).solve(heights_);
    const double sum = fit[2] + fit[4], squares = fit[2] * fit[2] + 2 * fit[3] * fit[3] + fit[4] * fit[4];
    const double cubes = 0.5 * sum * (3 * squares - sum * sum);
    return {fit[0], fit[1], (squares > 0 ? cubes / squares : 0.0) - k};
  }

 private:
  static constexpr Eigen::Index unknowns = 5;
  static constexpr double nearby = 0.1, dependent_column = 1e-3;

  std::vector<Point> points_;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd heights_;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver_;
};

/// The surface's normal at a node (smooth_edges.hpp) by Newton's method with a Jacobian of differences; steps are
/// halved until the residual falls. Nothing where that does not converge or there are too few points.
/// \param around  from the node, mm
std::optional<Point> fitted_normal(const std::vector<Point>& around, const Point& guess) {
  constexpr std::size_t enough = 7;
  constexpr int most_steps = 30, most_halvings = 10;
  constexpr double converged = 1e-12, least_difference = 1e-7;
  if (around.size() < enough) return std::nullopt;
  QuadricFit fit(around);
  Point normal = guess;
  double k = 0;
  for (int step = 0; step < most_steps; ++step) {
    const Point off = std::abs(normal[0]) < 0.7 ? Point{1, 0, 0} : Point{0, 1, 0};
    const Point first = unit(off - dot(off, normal) * normal), second = cross(normal, first);
    const auto tilted = [&](const Eigen::Vector3d& by) { return unit(normal - by[0] * first - by[1] * second); };
    const auto left_at = [&](const Eigen::Vector3d& by) -> Eigen::Vector3d {
      const Point there = tilted(by), along = unit(first - dot(first, there) * there);
      return fit(there, along, cross(there, along), k + by[2]);
    };
    const Eigen::Vector3d left = left_at(Eigen::Vector3d::Zero());
    if (left.norm() < converged) return normal;
    Eigen::Matrix3d jacobian;
    for (int i = 0; i < 3; ++i)
      jacobian.col(i) = (left_at(least_difference * Eigen::Vector3d::Unit(i)) - left) / least_difference;
    Eigen::Vector3d by = -jacobian.fullPivLu().solve(left);
    int halvings = 0;
    while (halvings <= most_halvings && !(left_at(by).norm() < left.norm())) {
      by *= 0.5;
      ++halvings;
    }
    if (halvings > most_halvings) return std::nullopt;
    normal = tilted(by);
    k += by[2];
    if (!(dot(normal, guess) > smooth_surface_cosine)) return std::nullopt;
  }
  return std::nullopt;
}

/// Facets in parts that are smooth, with the normals of their nodes.
class SmoothParts {
 public:
  SmoothParts(const std::vector<Point>& nodes, const std::vector<Facet>& facets)
      : nodes_(nodes), parts_(facets.size()) {
    for (const auto& [a, b, c] : facets) facet_normals_.push_back(cross(nodes[b] - nodes[a], nodes[c] - nodes[a]));
    for (std::size_t f = 0; f < facets.size(); ++f)
      for (int k = 0; k < 3; ++k)
        at_edge_[std::minmax(facets[f][k], facets[f][(k + 1) % 3])].push_back(static_cast<int>(f));
    for (const auto& [edge, meet] : at_edge_)
      if (meet.size() == 2 && !is_sharp(meet)) parts_.join(meet[0], meet[1]);
    for (std::size_t f = 0; f < facets.size(); ++f)
      for (const int node : facets[f]) {
        auto& here = at_[{parts_.root(static_cast<int>(f)), node}];
        here.guess = here.guess + facet_normals_[f];
        here.beside.insert(facets[f].begin(), facets[f].end());
      }
    for (auto& [place, here] : at_) {
      here.normal = unit(here.guess);
      const auto fitted = fitted_normal(around(place.first, place.second), here.normal);
      if (fitted)
        here.normal = *fitted;
      else
        not_fitted_.push_back(nodes_[place.second]);
    }
  }

  const std::map<Edge, std::vector<int>>& edges() const { return at_edge_; }
  /// Where nodes have the mean normal of their facets, since no quadric was found.
  const std::vector<Point>& not_fitted() const { return not_fitted_; }
  bool is_sharp(const std::vector<int>& meet) const {
    const Point &one = facet_normals_[meet[0]], &other = facet_normals_[meet[1]];
    return !(dot(one, other) > smooth_surface_cosine * norm(one) * norm(other));
  }
  const Point& normal(int facet, int node) { return at_.at({parts_.root(facet), node}).normal; }
  /// Whether a normal is near that of the facet.
  bool fits(const Point& normal, int facet) const {
    return dot(normal, facet_normals_[facet]) > smooth_surface_cosine * norm(facet_normals_[facet]);
  }

 private:
  struct Here {
    Point guess{0, 0, 0}, normal{0, 0, 0};
    std::set<int> beside;
  };

  /// Nodes within two edges, by facets of the part, from the node; those within three where these are few.
  std::vector<Point> around(int part, int node) const {
    constexpr std::size_t few = 10;
    std::set<int> found{node};
    for (int ring = 0; ring < 2 || (ring == 2 && found.size() < few); ++ring) {
      const auto before = found;
      for (const int other : before) {
        const auto& beside = at_.at({part, other}).beside;
        found.insert(beside.begin(), beside.end());
      }
    }
    found.erase(node);
    std::vector<Point> points;
    for (const int other : found) points.push_back(nodes_[other] - nodes_[node]);
    return points;
  }

  const std::vector<Point>& nodes_;
  DisjointSets parts_;
  std::vector<Point> facet_normals_;
  std::map<Edge, std::vector<int>> at_edge_;
  std::map<std::pair<int, int>, Here> at_;  // by part and node
  std::vector<Point> not_fitted_;
};

}  // namespace

SmoothEdges smooth_edges(const std::vector<Point>& nodes, const std::vector<Facet>& facets, const OffsetNormals& rims) {
  SmoothParts parts(nodes, facets);
  SmoothEdges smooth;
  smooth.edges = parts.edges().size();
  smooth.not_fitted = parts.not_fitted();
  for (const auto& [edge, meet] : parts.edges()) {
    if (meet.size() == 2 && parts.is_sharp(meet)) {
      ++smooth.sharp;
      continue;
    }
    const auto& [a, b] = edge;
    Point one = parts.normal(meet[0], a), other = parts.normal(meet[0], b);
    if (std::any_of(meet.begin(), meet.end(),
                    [&](int facet) { return !parts.fits(one, facet) || !parts.fits(other, facet); }))
      continue;
    if (meet.size() == 1) {
      const auto plane = plane_of_rim_edge(rims.planes, edge);
      one = unit(in_planes(one, plane));
      other = unit(in_planes(other, plane));
    }
    if (!(dot(one, other) > smooth_surface_cosine)) continue;
    const Point along = nodes[b] - nodes[a], sum = one + other, middle = 0.5 * (nodes[a] + nodes[b]);
    const double length = norm(sum), sagitta = dot(along, other - one) / (2 * (2 + length));
    smooth.curves[edge] = middle + (sagitta / length) * sum;
    if (std::abs(sagitta) > least_curved * norm(along)) ++smooth.curved;
    if (std::abs(sagitta) > smooth.farthest) {
      smooth.farthest = std::abs(sagitta);
      smooth.farthest_at = middle;
    }
  }
  return smooth;
}

std::string to_text(const SmoothEdges& smooth) {
  std::string text =
      fmt::format("{} of the {} edges of the lumen's surface are curved, as the normals at their ends ask for",
                  smooth.curved, smooth.edges);
  if (smooth.curved > 0)
    text += fmt::format(", by {:.3g} mm at most, at {}", smooth.farthest, place_of(smooth.farthest_at));
  if (smooth.sharp > 0) text += fmt::format("; {} in folds of more than 53 degrees stay straight", smooth.sharp);
  if (!smooth.not_fitted.empty())
    text += fmt::format(
        "; at {} nodes, the first at {}, the normal is the mean of the facets', since no quadric was found "
        "through the nodes around",
        smooth.not_fitted.size(), place_of(smooth.not_fitted.front()));
  return text + ".\n";
}

}  // namespace fsi
