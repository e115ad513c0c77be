#include "mesher/surface/curvature.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>

#include "mesh/point_math.hpp"
#include "mesher/surface/local_radius.hpp"

namespace fsi {

namespace {

/// Nodes within two edges, by triangles, the node itself left out.
std::vector<std::vector<int>> two_rings(const TriangleSurface& surface) {
  std::vector<std::set<int>> ring(surface.nodes.size());
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) {
      ring[t[k]].insert(t[(k + 1) % 3]);
      ring[t[k]].insert(t[(k + 2) % 3]);
    }
  std::vector<std::vector<int>> rings;
  for (std::size_t node = 0; node < ring.size(); ++node) {
    std::set<int> both = ring[node];
    for (const int next : ring[node]) both.insert(ring[next].begin(), ring[next].end());
    both.erase(static_cast<int>(node));
    rings.emplace_back(both.begin(), both.end());
  }
  return rings;
}

double curvature_at(const Point& x, const Point& normal, const std::vector<int>& around,
                    const std::vector<Point>& nodes) {
  constexpr int unknowns = 5;
  if (around.size() < unknowns) return 0;
  const Point off = std::abs(normal[0]) < 0.7 ? Point{1, 0, 0} : Point{0, 1, 0};
  Point first = off - dot(off, normal) * normal;
  first = (1 / norm(first)) * first;
  const Point second = cross(normal, first);
  Eigen::MatrixXd terms(around.size(), unknowns);
  Eigen::VectorXd heights(around.size());
  double scale = 0;
  for (const int node : around) scale = std::max(scale, distance(nodes[node], x));
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Point from = (1 / scale) * (nodes[around[i]] - x);
    const double u = dot(from, first), v = dot(from, second);
    terms.row(static_cast<Eigen::Index>(i)) << u, v, u * u, u * v, v * v;
    heights(static_cast<Eigen::Index>(i)) = dot(from, normal);
  }
  const Eigen::VectorXd fit = terms.colPivHouseholderQr().solve(heights);
  const double d = fit[0], e = fit[1], w = 1 + d * d + e * e;
  Eigen::Matrix2d metric, second_form;
  metric << 1 + d * d, d * e, d * e, 1 + e * e;
  second_form << 2 * fit[2], fit[3], fit[3], 2 * fit[4];
  const Eigen::Matrix2d shape = metric.inverse() * second_form / (std::sqrt(w) * scale);
  const double mean = 0.5 * shape.trace(), spread = std::sqrt(std::max(0.0, mean * mean - shape.determinant()));
  return std::abs(mean) + spread;
}

}  // namespace

std::vector<double> largest_curvature(const TriangleSurface& surface, int passes) {
  const auto normals = area_vectors_at_nodes(surface);
  const auto rings = two_rings(surface);
  std::vector<double> curvature;
  for (std::size_t node = 0; node < surface.nodes.size(); ++node) {
    const double length = norm(normals[node]);
    curvature.push_back(
        length > 0 ? curvature_at(surface.nodes[node], (1 / length) * normals[node], rings[node], surface.nodes) : 0);
  }
  average_with_neighbours(surface, curvature, passes);
  return curvature;
}

void shorten_by_curvature(const TriangleSurface& surface, double per_curvature, double shortest,
                          std::vector<double>& edges) {
  constexpr int passes = 3;
  const auto curvature = largest_curvature(surface, passes);
  for (std::size_t node = 0; node < edges.size(); ++node) {
    const double bent = 2 / (per_curvature * std::max(curvature[node], 1e-300));
    edges[node] = std::min(edges[node], std::max(bent, shortest));
  }
}

}  // namespace fsi
