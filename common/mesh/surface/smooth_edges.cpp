#include "mesh/surface/smooth_edges.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "mesh/disjoint_sets.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

using Facet = TetrahedralMesh::Facet;
using Edge = std::pair<int, int>;

constexpr double smooth_edge =
    0.6;  // cosine of the angle between normals of one smooth surface, as of recovered stresses
constexpr double least_curved = 1e-3;  // of the edge

Point unit(const Point& v) {
  return (1 / std::max(norm(v), 1e-300)) * v;
}

/// The surface's normal at a node (smooth_edges.hpp); the first guess where the points around do not tell it.
/// \param around  from the node, mm
Point fitted_normal(const std::vector<Point>& around, const Point& guess) {
  constexpr Eigen::Index unknowns = 5;
  constexpr std::size_t enough = 7;
  constexpr int most_steps = 100;
  constexpr double converged = 1e-12, nearby = 0.1, dependent_column = 1e-3;
  if (around.size() < enough) return guess;
  const auto rows = static_cast<Eigen::Index>(around.size());
  double square = 0;
  for (const Point& y : around) square += dot(y, y) / static_cast<double>(rows);
  const double size = std::sqrt(square);
  Point normal = guess;
  double k = 0;
  Eigen::MatrixXd matrix(rows, unknowns);
  Eigen::VectorXd heights(rows);
  for (int step = 0; step < most_steps; ++step) {
    const Point off = std::abs(normal[0]) < 0.7 ? Point{1, 0, 0} : Point{0, 1, 0};
    const Point first = unit(off - dot(off, normal) * normal), second = cross(normal, first);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const Point y = (1 / size) * around[static_cast<std::size_t>(i)];
      const double u = dot(y, first), v = dot(y, second), z = dot(y, normal);
      const double weight = std::pow(dot(y, y) + nearby, -2);
      matrix.row(i) << u, v, 0.5 * u * u, u * v, 0.5 * v * v;
      matrix.row(i) *= weight;
      heights[i] = weight * (z - 0.5 * k * z * z);
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(dependent_column);
    const Eigen::VectorXd fit = solver.compute(matrix).solve(heights);
    const double mean = 0.5 * (fit[2] + fit[4]);
    const double spread = std::hypot(0.5 * (fit[2] - fit[4]), fit[3]);
    const double before = k;
    k = mean < 0 ? mean - spread : mean + spread;
    normal = unit(normal - fit[0] * first - fit[1] * second);
    if (!(dot(normal, guess) > smooth_edge)) return guess;
    if (std::hypot(fit[0], fit[1]) < converged && std::abs(k - before) < converged) break;
  }
  return normal;
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
    for (auto& [place, here] : at_) here.normal = fitted_normal(around(place.first, place.second), unit(here.guess));
  }

  const std::map<Edge, std::vector<int>>& edges() const { return at_edge_; }
  bool is_sharp(const std::vector<int>& meet) const {
    const Point &one = facet_normals_[meet[0]], &other = facet_normals_[meet[1]];
    return !(dot(one, other) > smooth_edge * norm(one) * norm(other));
  }
  const Point& normal(int facet, int node) { return at_.at({parts_.root(facet), node}).normal; }
  /// Whether a normal is near that of the facet.
  bool fits(const Point& normal, int facet) const {
    return dot(normal, facet_normals_[facet]) > smooth_edge * norm(facet_normals_[facet]);
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
};

}  // namespace

SmoothEdges smooth_edges(const std::vector<Point>& nodes, const std::vector<Facet>& facets, const OffsetNormals& rims) {
  SmoothParts parts(nodes, facets);
  SmoothEdges smooth;
  smooth.edges = parts.edges().size();
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
    if (!(dot(one, other) > smooth_edge)) continue;
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
  return text + ".\n";
}

}  // namespace fsi
