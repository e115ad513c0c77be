#include "mesh/sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double inside = -1e-9;        // barycentric coordinates this far below zero are rounding
constexpr double furthest_edges = 0.5;  // longest edges that a point may lie outside

/// Cells sorted into the boxes of a regular grid that their bounding boxes touch.
class CellGrid {
 public:
  CellGrid(const TetrahedralMesh& mesh, const std::vector<int>& cells) {
    low_.fill(std::numeric_limits<double>::infinity());
    Point high;
    high.fill(-std::numeric_limits<double>::infinity());
    for (const int c : cells)
      for (const int node : mesh.cells[c])
        for (int d = 0; d < 3; ++d) {
          low_[d] = std::min(low_[d], mesh.nodes[node][d]);
          high[d] = std::max(high[d], mesh.nodes[node][d]);
        }
    // About one box per cell, cubic ones, so that a long tube gets many along its axis.
    double volume = 1;
    for (int d = 0; d < 3; ++d) volume *= std::max(high[d] - low_[d], 1e-300);
    step_ = std::cbrt(volume / static_cast<double>(cells.size()));
    if (!(step_ > 0)) step_ = 1;
    for (int d = 0; d < 3; ++d) boxes_[d] = static_cast<int>(std::clamp((high[d] - low_[d]) / step_, 0.0, 1000.0)) + 1;

    std::vector<std::array<int, 2>> entries;  // box, cell
    for (const int c : cells) {
      std::array<int, 3> from{boxes_}, to{0, 0, 0};
      for (const int node : mesh.cells[c])
        for (int d = 0; d < 3; ++d) {
          const int box = box_along(d, mesh.nodes[node][d]);
          from[d] = std::min(from[d], box);
          to[d] = std::max(to[d], box);
        }
      for (int i = from[0]; i <= to[0]; ++i)
        for (int j = from[1]; j <= to[1]; ++j)
          for (int k = from[2]; k <= to[2]; ++k) entries.push_back({box_number(i, j, k), c});
    }
    std::sort(entries.begin(), entries.end());
    start_.assign(static_cast<std::size_t>(boxes_[0]) * boxes_[1] * boxes_[2] + 1, 0);
    for (const auto& entry : entries) {
      ++start_[entry[0] + 1];
      cells_.push_back(entry[1]);
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
  }

  /// Cells that may hold the point, ascending.
  std::pair<const int*, const int*> near(const Point& x) const {
    const int box = box_number(box_along(0, x[0]), box_along(1, x[1]), box_along(2, x[2]));
    assert(box >= 0 && static_cast<std::size_t>(box) + 1 < start_.size());
    return {cells_.data() + start_[box], cells_.data() + start_[box + 1]};
  }

 private:
  int box_along(int d, double value) const {
    return static_cast<int>(std::clamp((value - low_[d]) / step_, 0.0, static_cast<double>(boxes_[d] - 1)));
  }
  int box_number(int i, int j, int k) const { return (i * boxes_[1] + j) * boxes_[2] + k; }

  Point low_;
  double step_;
  std::array<int, 3> boxes_;
  std::vector<int> start_, cells_;
};

std::array<double, 4> barycentric(const TetrahedralMesh& mesh, int cell, const Point& x) {
  const auto& c = mesh.cells[cell];
  const Point &a = mesh.nodes[c[0]], &b = mesh.nodes[c[1]], &p = mesh.nodes[c[2]], &q = mesh.nodes[c[3]];
  const double volume = tetrahedron_volume(a, b, p, q);
  const double wb = tetrahedron_volume(a, x, p, q) / volume, wp = tetrahedron_volume(a, b, x, q) / volume,
               wq = tetrahedron_volume(a, b, p, x) / volume;
  return {1 - wb - wp - wq, wb, wp, wq};
}

/// Negative weights become zero, the rest is scaled to the sum 1.
template <std::size_t N>
std::array<double, N> clamped(std::array<double, N> weights) {
  double sum = 0;
  for (double& w : weights) sum += w = std::max(w, 0.0);
  for (double& w : weights) w /= sum;
  return weights;
}

/// The nearest cell by the distance to the point's clamped image in it.
PointSample nearest_sample(const TetrahedralMesh& mesh, const std::vector<int>& cells, const Point& x) {
  PointSample best{};
  double least = std::numeric_limits<double>::infinity();
  for (const int c : cells) {
    const auto weights = clamped(barycentric(mesh, c, x));
    Point image{0, 0, 0};
    for (int i = 0; i < 4; ++i) image = image + weights[i] * mesh.nodes[mesh.cells[c][i]];
    const double away = distance(image, x);
    if (away >= least) continue;
    least = away;
    best = {mesh.cells[c], weights};
  }
  double longest = 0;
  for (const int a : best.nodes)
    for (const int b : best.nodes) longest = std::max(longest, distance(mesh.nodes[a], mesh.nodes[b]));
  if (!(least <= furthest_edges * longest))
    throw InputError("", fmt::format("point ({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]),
                     fmt::format("lies {:.3g} mm outside the mesh", least),
                     "check the axis and the unit of the mesh (mm)");
  return best;
}

double wrapped(double angle) {
  return angle - 2 * pi * std::round(angle / (2 * pi));
}

}  // namespace

std::vector<PointSample> sample_in_cells(const TetrahedralMesh& mesh, int region, const std::vector<Point>& points) {
  assert(mesh.cell_region.size() == mesh.cells.size());
  assert(region < static_cast<int>(mesh.regions.size()));
  std::vector<int> cells;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (region < 0 || mesh.cell_region[c] == region) cells.push_back(static_cast<int>(c));
  std::vector<PointSample> samples;
  if (points.empty()) return samples;
  if (cells.empty()) throw InputError("", "sampling", "there are no cells to sample in", "choose another volume");

  const CellGrid grid(mesh, cells);
  samples.reserve(points.size());
  for (const Point& x : points) {
    const auto [begin, end] = grid.near(x);
    double most = inside;
    const int* holder = nullptr;
    std::array<double, 4> weights{};
    for (const int* c = begin; c != end; ++c) {
      const auto candidate = barycentric(mesh, *c, x);
      const double least = *std::min_element(candidate.begin(), candidate.end());
      if (least < most || (holder != nullptr && least <= most)) continue;
      most = least;
      holder = c;
      weights = candidate;
    }
    samples.push_back(holder != nullptr ? PointSample{mesh.cells[*holder], weights} : nearest_sample(mesh, cells, x));
  }
  return samples;
}

std::vector<WallSample> wall_samples(const std::vector<Point>& nodes,
                                     const std::vector<TetrahedralMesh::Facet>& surface, const Axis& axis,
                                     const std::vector<double>& positions, int angles) {
  assert(angles > 0);
  const AxisFrame frame(axis);
  struct Unrolled {
    std::array<double, 3> angle, axial;
    double radius, longest;
  };
  std::vector<Unrolled> facets;
  facets.reserve(surface.size());
  for (const auto& f : surface) {
    Unrolled facet{};
    for (int i = 0; i < 3; ++i) {
      facet.angle[i] = frame.angle(nodes[f[i]]);
      facet.axial[i] = frame.axial(nodes[f[i]]);
      facet.radius += frame.radius(nodes[f[i]]) / 3;
      facet.longest = std::max(facet.longest, distance(nodes[f[i]], nodes[f[(i + 1) % 3]]));
    }
    facets.push_back(facet);
  }

  std::vector<WallSample> samples;
  samples.reserve(positions.size() * angles);
  std::vector<std::size_t> near;
  for (const double z : positions) {
    near.clear();
    for (std::size_t f = 0; f < facets.size(); ++f) {
      const auto [low, high] = std::minmax_element(facets[f].axial.begin(), facets[f].axial.end());
      if (z >= *low - furthest_edges * facets[f].longest && z <= *high + furthest_edges * facets[f].longest)
        near.push_back(f);
    }
    for (int k = 0; k < angles; ++k) {
      const double angle = 2 * pi * k / angles;
      double least = std::numeric_limits<double>::infinity(), allowed = 0;
      WallSample best{};
      for (const std::size_t f : near) {
        const auto& facet = facets[f];
        std::array<double, 3> s;  // mm around the tube from the wanted angle
        for (int i = 0; i < 3; ++i) s[i] = facet.radius * wrapped(facet.angle[i] - angle);
        const auto [low, high] = std::minmax_element(s.begin(), s.end());
        if (*high - *low > pi * facet.radius) continue;  // on the far side, torn apart by the unrolling
        const auto& t = facet.axial;
        const double area = (s[1] - s[0]) * (t[2] - t[0]) - (s[2] - s[0]) * (t[1] - t[0]);
        if (std::abs(area) < 1e-12 * facet.longest * facet.longest) continue;  // seen edge-on
        const double w1 = ((0 - s[0]) * (t[2] - t[0]) - (s[2] - s[0]) * (z - t[0])) / area;
        const double w2 = ((s[1] - s[0]) * (z - t[0]) - (0 - s[0]) * (t[1] - t[0])) / area;
        const std::array<double, 3> weights{1 - w1 - w2, w1, w2};
        const bool holds = *std::min_element(weights.begin(), weights.end()) >= inside;
        const auto kept = holds ? weights : clamped(weights);
        double ds = 0, dz = -z;
        for (int i = 0; i < 3; ++i) {
          ds += kept[i] * s[i];
          dz += kept[i] * t[i];
        }
        const double away = holds ? 0.0 : std::hypot(ds, dz);
        if (away >= least) continue;
        least = away;
        allowed = furthest_edges * facet.longest;
        best = {frame.radial(angle), surface[f], kept};
        if (holds) break;
      }
      if (!(least <= allowed))
        throw InputError("", fmt::format("inner wall at {:.6g} mm along the axis, {:.4g} deg", z, angle * 180 / pi),
                         "there is no surface", "check the axis and the unit of the mesh (mm)");
      samples.push_back(best);
    }
  }
  return samples;
}

double axial_position(const std::vector<Point>& nodes, const std::vector<TetrahedralMesh::Facet>& surface,
                      const Axis& axis) {
  const AxisFrame frame(axis);
  const auto members = facet_nodes(surface);
  double sum = 0;
  for (const int node : members) sum += frame.axial(nodes[node]);
  return members.empty() ? 0 : sum / static_cast<double>(members.size());
}

std::vector<double> evenly_spaced(double first, double last, int count) {
  assert(count >= 0);
  std::vector<double> values(count);
  for (int i = 0; i < count; ++i) values[i] = (first * (count - 1 - i) + last * i) / std::max(1, count - 1);
  return values;
}

std::vector<Point> points_on_axis(const Axis& axis, const std::vector<double>& positions) {
  const AxisFrame frame(axis);
  std::vector<Point> points;
  for (const double z : positions) points.push_back(frame.origin + z * frame.along);
  return points;
}

}  // namespace fsi
