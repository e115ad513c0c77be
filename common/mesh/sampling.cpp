#include "mesh/sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.hpp"
#include "math/pi.hpp"
#include "mesh/boundary.hpp"
#include "mesh/cell_map.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double inside = -1e-9;        // barycentric coordinates this far below zero are rounding
constexpr double on_boundary = -1e-6;   // and of points that users type with a few digits
constexpr double furthest_edges = 0.5;  // longest edges that a point may lie outside

/// \tparam Mesh  a mesh or a part of one
template <int Dim, int Order, template <int, int> class Mesh>
CellMap<Dim, Order> map_of(const Mesh<Dim, Order>& mesh, int cell) {
  CellMap<Dim, Order> map;
  for (std::size_t i = 0; i < map.x.size(); ++i) map.x[i] = mesh.nodes[mesh.cells[cell][i]];
  return map;
}

/// Points in whose convex hull a cell lies: its vertices and, for each curved edge, the middle control point of its
/// Bezier curve.
template <int Dim, int Order, template <int, int> class Mesh>
std::array<Point, nodes_of_simplex(Dim, Order)> control_points(const Mesh<Dim, Order>& mesh, int cell) {
  auto x = map_of(mesh, cell).x;
  if constexpr (Order == 2)
    for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
      const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
      x[Dim + 1 + e] = 2 * x[Dim + 1 + e] - 0.5 * (x[a] + x[b]);
    }
  return x;
}

/// Cells sorted into the boxes of a regular grid that their bounding boxes touch.
class CellGrid {
 public:
  template <int Dim, int Order, template <int, int> class Mesh>
  CellGrid(const Mesh<Dim, Order>& mesh, const std::vector<int>& cells) {
    low_.fill(std::numeric_limits<double>::infinity());
    Point high;
    high.fill(-std::numeric_limits<double>::infinity());
    for (const int c : cells)
      for (const Point& x : control_points(mesh, c))
        for (int d = 0; d < 3; ++d) {
          low_[d] = std::min(low_[d], x[d]);
          high[d] = std::max(high[d], x[d]);
        }
    // About one box per cell, cubic ones, so that a long tube gets many along its axis.
    double volume = 1;
    for (int d = 0; d < 3; ++d)
      if (Dim == 3 || high[d] > low_[d]) volume *= std::max(high[d] - low_[d], 1e-300);
    const double each = volume / static_cast<double>(cells.size());
    step_ = Dim == 3 ? std::cbrt(each) : std::sqrt(each);
    if (!(step_ > 0)) step_ = 1;
    for (int d = 0; d < 3; ++d) boxes_[d] = static_cast<int>(std::clamp((high[d] - low_[d]) / step_, 0.0, 1000.0)) + 1;

    std::vector<std::array<int, 2>> entries;  // box, cell
    for (const int c : cells) {
      std::array<int, 3> from{boxes_}, to{0, 0, 0};
      for (const Point& x : control_points(mesh, c))
        for (int d = 0; d < 3; ++d) {
          const int box = box_along(d, x[d]);
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

constexpr const char* axis_remedy =
    "check structure.axis_origin and structure.axis_direction, and that the mesh is in mm";

/// Negative weights become zero, the rest is scaled to the sum 1.
template <std::size_t N>
std::array<double, N> clamped(std::array<double, N> weights) {
  double sum = 0;
  for (double& w : weights) sum += w = std::max(w, 0.0);
  for (double& w : weights) w /= sum;
  return weights;
}

template <int Dim, int Order, template <int, int> class Mesh>
PointSample sample_of(const Mesh<Dim, Order>& mesh, int cell, const std::array<double, Dim + 1>& l) {
  const auto& nodes = mesh.cells[cell];
  const auto weights = CellMap<Dim, Order>::shape(l);
  return {{nodes.begin(), nodes.end()}, {weights.begin(), weights.end()}, {l.begin(), l.end()}};
}

/// The cell that holds a point deepest, the first of them among several.
template <int Dim>
struct Holder {
  int cell = -1;  ///< none
  std::array<double, Dim + 1> place{};
};

/// \param furthest  how negative a barycentric coordinate of a point in a cell may be
template <int Dim, int Order, template <int, int> class Mesh>
Holder<Dim> holder_of(const Mesh<Dim, Order>& mesh, const CellGrid& grid, const Point& x, double furthest) {
  const auto [begin, end] = grid.near(x);
  Holder<Dim> holder;
  double most = furthest;
  for (const int* c = begin; c != end; ++c) {
    std::array<double, Dim + 1> candidate;
    if (!map_of(mesh, *c).find(x, candidate)) continue;
    const double least = *std::min_element(candidate.begin(), candidate.end());
    if (least < most || (holder.cell >= 0 && least <= most)) continue;
    most = least;
    holder = {*c, candidate};
  }
  return holder;
}

/// The nearest cell by the distance to the point's clamped image in it.
template <int Dim, int Order>
PointSample nearest_sample(const SimplexMesh<Dim, Order>& mesh, const std::vector<int>& cells, const Point& x,
                           const SamplingPlace& from) {
  int best = -1;
  std::array<double, Dim + 1> best_place{};
  double least = std::numeric_limits<double>::infinity();
  for (const int c : cells) {
    const auto map = map_of(mesh, c);
    std::array<double, Dim + 1> place;
    if (!map.find(x, place)) place = map.straight(x);
    const auto kept = clamped(place);
    const double away = distance(map.at(kept), x);
    if (away >= least) continue;
    least = away;
    best = c;
    best_place = kept;
  }
  double longest = 0;
  if (best >= 0)
    for (int a = 0; a <= Dim; ++a)
      for (int b = 0; b <= Dim; ++b)
        longest = std::max(longest, distance(mesh.nodes[mesh.cells[best][a]], mesh.nodes[mesh.cells[best][b]]));
  if (!(least <= furthest_edges * longest))
    throw InputError(from.file, from.key,
                     fmt::format("the point ({:.6g}, {:.6g}, {:.6g}) lies {:.3g} mm outside", x[0], x[1], x[2], least),
                     axis_remedy);
  return sample_of(mesh, best, best_place);
}

double wrapped(double angle) {
  return angle - 2 * pi * std::round(angle / (2 * pi));
}

/// A facet of a tube's surface with its angles and axial positions.
template <std::size_t Nodes>
struct Unrolled {
  std::array<double, Nodes> angle, axial;
  double radius, longest;
  std::array<int, Nodes> nodes;
};

template <std::size_t Nodes>
std::vector<Unrolled<Nodes>> unroll(const std::vector<Point>& nodes, const std::vector<std::array<int, Nodes>>& surface,
                                    const AxisFrame& frame) {
  std::vector<Unrolled<Nodes>> facets;
  facets.reserve(surface.size());
  for (const auto& f : surface) {
    Unrolled<Nodes> facet{};
    facet.nodes = f;
    for (std::size_t i = 0; i < Nodes; ++i) {
      facet.angle[i] = frame.angle(nodes[f[i]]);
      facet.axial[i] = frame.axial(nodes[f[i]]);
      facet.radius += frame.radius(nodes[f[i]]) / Nodes;
    }
    for (int i = 0; i < 3; ++i) facet.longest = std::max(facet.longest, distance(nodes[f[i]], nodes[f[(i + 1) % 3]]));
    facets.push_back(facet);
  }
  return facets;
}

/// The angles that a surface covers, from `first` on; `span` is a full turn for a whole tube.
struct AngularRange {
  double first = -pi, span = 2 * pi;
};

template <std::size_t Nodes>
AngularRange covered_angles(const std::vector<Unrolled<Nodes>>& facets) {
  constexpr double smallest_gap = 1e-3;
  std::vector<std::array<double, 2>> arcs;
  for (const auto& facet : facets) {
    double low = 0, high = 0;
    for (const double angle : facet.angle) {
      low = std::min(low, wrapped(angle - facet.angle[0]));
      high = std::max(high, wrapped(angle - facet.angle[0]));
    }
    if (high - low > pi) return {};  // holds the axis
    arcs.push_back({facet.angle[0] + low, facet.angle[0] + high});
  }
  if (arcs.empty()) return {};
  std::sort(arcs.begin(), arcs.end());
  // The widest gap, the one from the last arc round to the first among them.
  double reached = arcs[0][1], widest = 0, begin = arcs[0][0];
  for (const auto& arc : arcs) {
    if (arc[0] - reached > widest) {
      widest = arc[0] - reached;
      begin = arc[0];
    }
    reached = std::max(reached, arc[1]);
  }
  if (const double round = arcs[0][0] + 2 * pi - reached; round > widest) {
    widest = round;
    begin = arcs[0][0];
  }
  return widest < smallest_gap ? AngularRange{} : AngularRange{begin, 2 * pi - widest};
}

/// Angles whose samples have the mean over the whole tube as their mean.
std::vector<double> sampled_angles(const AngularRange& range, int count) {
  std::vector<double> angles(count);
  const double turns = 2 * pi / range.span;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * pi * k / count;
    if (range.span == 2 * pi) {
      angles[k] = angle;
    } else if (std::abs(turns - std::round(turns)) < 1e-6) {
      // Mirrored at both ends until it lies within.
      const double along = std::fmod(std::fmod(angle - range.first, 2 * range.span) + 2 * range.span, 2 * range.span);
      angles[k] = range.first + std::min(along, 2 * range.span - along);
    } else {
      angles[k] = range.first + (k + 0.5) * range.span / count;
    }
  }
  return angles;
}

[[noreturn]] void no_surface(double z, double angle, const SamplingPlace& from) {
  throw InputError(
      from.file, from.key,
      fmt::format("there is no inner wall {:.6g} mm along the axis, at {:.4g} degrees around it", z, angle * 180 / pi),
      axis_remedy);
}

/// Interpolation at one position and angle on the facets listed.
template <std::size_t Nodes>
WallSample wall_sample(const std::vector<Unrolled<Nodes>>& facets, const std::vector<std::size_t>& near,
                       const AxisFrame& frame, double z, double angle, const SamplingPlace& from) {
  constexpr int order = Nodes == 3 ? 1 : 2;
  double least = std::numeric_limits<double>::infinity(), allowed = 0;
  std::size_t nearest = 0;
  std::array<double, 3> best{};
  for (const std::size_t f : near) {
    const auto& facet = facets[f];
    std::array<double, Nodes> s;  // mm around the tube from the wanted angle
    for (std::size_t i = 0; i < Nodes; ++i) s[i] = facet.radius * wrapped(facet.angle[i] - angle);
    const auto [low, high] = std::minmax_element(s.begin(), s.end());
    if (*high - *low > pi * facet.radius) continue;  // on the far side, torn apart by the unrolling
    const auto& t = facet.axial;
    const double area = (s[1] - s[0]) * (t[2] - t[0]) - (s[2] - s[0]) * (t[1] - t[0]);
    if (std::abs(area) < 1e-12 * facet.longest * facet.longest) continue;  // seen edge-on
    const double w1 = ((0 - s[0]) * (t[2] - t[0]) - (s[2] - s[0]) * (z - t[0])) / area;
    const double w2 = ((s[1] - s[0]) * (z - t[0]) - (0 - s[0]) * (t[1] - t[0])) / area;
    std::array<double, 3> place{1 - w1 - w2, w1, w2};
    CellMap<2, order> map;
    for (std::size_t i = 0; i < Nodes; ++i) map.x[i] = {s[i], t[i], 0};
    if constexpr (order == 2)
      if (std::array<double, 3> curved; map.find({0, z, 0}, curved)) place = curved;
    const bool holds = *std::min_element(place.begin(), place.end()) >= inside;
    const auto kept = holds ? place : clamped(place);
    double ds = 0, dz = -z;
    const auto weights = map.shape(kept);
    for (std::size_t i = 0; i < Nodes; ++i) {
      ds += weights[i] * s[i];
      dz += weights[i] * t[i];
    }
    const double away = holds ? 0.0 : std::hypot(ds, dz);
    if (away >= least) continue;
    least = away;
    allowed = furthest_edges * facet.longest;
    nearest = f;
    best = kept;
    if (holds) break;
  }
  if (!(least <= allowed)) no_surface(z, angle, from);
  const auto& nodes = facets[nearest].nodes;
  const auto weights = CellMap<2, order>::shape(best);
  return {frame.radial(angle), {nodes.begin(), nodes.end()}, {weights.begin(), weights.end()}};
}

/// Place along a straight or quadratic edge, 0 to 1, where its axial position is nearest to z.
template <std::size_t Nodes>
double place_along(const std::array<double, Nodes>& axial, double z) {
  double t = std::clamp((z - axial[0]) / (axial[1] - axial[0]), 0.0, 1.0);
  if constexpr (Nodes == 3)
    // axial(t) = a + b t + c t^2 with the middle node at t = 1/2.
    for (int step = 0; step < 30; ++step) {
      const double c = 2 * (axial[0] + axial[1] - 2 * axial[2]), b = axial[1] - axial[0] - c;
      const double slope = b + 2 * c * t, change = (z - (axial[0] + t * (b + c * t))) / slope;
      if (!std::isfinite(change)) break;
      t = std::clamp(t + change, 0.0, 1.0);
      if (std::abs(change) < 1e-14) break;
    }
  return t;
}

/// Interpolation at one position on the edges that an axisymmetric surface is drawn as.
template <std::size_t Nodes>
WallSample meridian_sample(const std::vector<Point>& nodes, const std::vector<std::array<int, Nodes>>& surface,
                           const AxisFrame& frame, double z, const SamplingPlace& from) {
  double least = std::numeric_limits<double>::infinity(), allowed = 0;
  WallSample best{};
  for (const auto& edge : surface) {
    std::array<double, Nodes> axial;
    for (std::size_t i = 0; i < Nodes; ++i) axial[i] = frame.axial(nodes[edge[i]]);
    const double length = distance(nodes[edge[0]], nodes[edge[1]]);
    if (std::abs(axial[1] - axial[0]) < 1e-12 * length) continue;  // normal to the axis
    const double t = place_along(axial, z);
    std::array<double, Nodes> weights;
    if constexpr (Nodes == 2)
      weights = {1 - t, t};
    else
      weights = {(1 - t) * (1 - 2 * t), t * (2 * t - 1), 4 * t * (1 - t)};
    double reached = 0;
    for (std::size_t i = 0; i < Nodes; ++i) reached += weights[i] * axial[i];
    const double away = std::abs(reached - z);
    if (away >= least) continue;
    least = away;
    allowed = furthest_edges * length;
    best = {{1, 0, 0}, {edge.begin(), edge.end()}, {weights.begin(), weights.end()}};
    if (away <= -inside * length) break;
  }
  if (!(least <= allowed)) no_surface(z, 0, from);
  return best;
}

}  // namespace

template <int Dim, int Order>
std::vector<PointSample> sample_in_cells(const SimplexMesh<Dim, Order>& mesh, int region,
                                         const std::vector<Point>& points, const SamplingPlace& from) {
  assert(mesh.cell_region.size() == mesh.cells.size());
  assert(region < static_cast<int>(mesh.regions.size()));
  std::vector<int> cells;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (region < 0 || mesh.cell_region[c] == region) cells.push_back(static_cast<int>(c));
  std::vector<PointSample> samples;
  if (points.empty()) return samples;
  if (cells.empty()) throw InputError(from.file, from.key, "has no cells", "give it some");

  const CellGrid grid(mesh, cells);
  samples.reserve(points.size());
  for (const Point& x : points) {
    const Holder<Dim> holder = holder_of(mesh, grid, x, inside);
    samples.push_back(holder.cell >= 0 ? sample_of(mesh, holder.cell, holder.place)
                                       : nearest_sample(mesh, cells, x, from));
  }
  return samples;
}

template <int Dim, int Order>
std::vector<std::optional<PointSample>> locate_in_cells(const Submesh<Dim, Order>& part,
                                                        const std::vector<Point>& points) {
  std::vector<std::optional<PointSample>> samples(points.size());
  if (points.empty() || part.cells.empty()) return samples;
  const CellGrid grid(part, all_cells(part));
  const auto off_plane = [&](const Point& x) {
    if constexpr (Dim == 3) return false;
    // The plane of the part is that of its first cell.
    const auto map = map_of(part, 0);
    const Point normal = cross(map.x[1] - map.x[0], map.x[2] - map.x[0]);
    return std::abs(dot(x - map.x[0], normal)) > -on_boundary * std::pow(norm(normal), 1.5);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (off_plane(points[i])) continue;
    const Holder<Dim> holder = holder_of(part, grid, points[i], on_boundary);
    if (holder.cell >= 0) samples[i] = sample_of(part, holder.cell, clamped(holder.place));
  }
  return samples;
}

template <int Dim, std::size_t Nodes>
std::vector<WallSample> wall_samples(const std::vector<Point>& nodes,
                                     const std::vector<std::array<int, Nodes>>& surface, const Axis& axis,
                                     const std::vector<double>& positions, int angles, const SamplingPlace& from) {
  static_assert(Nodes == nodes_of_simplex(Dim - 1, 1) || Nodes == nodes_of_simplex(Dim - 1, 2));
  assert(angles > 0);
  const AxisFrame frame(axis);
  std::vector<WallSample> samples;
  if constexpr (Dim == 2) {
    for (const double z : positions) samples.push_back(meridian_sample(nodes, surface, frame, z, from));
  } else {
    const auto facets = unroll(nodes, surface, frame);
    const auto wanted = sampled_angles(covered_angles(facets), angles);
    samples.reserve(positions.size() * angles);
    std::vector<std::size_t> near;
    for (const double z : positions) {
      near.clear();
      for (std::size_t f = 0; f < facets.size(); ++f) {
        const auto [low, high] = std::minmax_element(facets[f].axial.begin(), facets[f].axial.end());
        if (z >= *low - furthest_edges * facets[f].longest && z <= *high + furthest_edges * facets[f].longest)
          near.push_back(f);
      }
      for (const double angle : wanted) samples.push_back(wall_sample(facets, near, frame, z, angle, from));
    }
  }
  return samples;
}

template <std::size_t Nodes>
double axial_position(const std::vector<Point>& nodes, const std::vector<std::array<int, Nodes>>& surface,
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

// Numbers as template arguments: parentheses would only hide them.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define INSTANTIATE(Dim, Order)                                                                                      \
  template std::vector<PointSample> sample_in_cells(const SimplexMesh<Dim, Order>&, int, const std::vector<Point>&,  \
                                                    const SamplingPlace&);                                           \
  template std::vector<std::optional<PointSample>> locate_in_cells(const Submesh<Dim, Order>&,                       \
                                                                   const std::vector<Point>&);                       \
  template std::vector<WallSample> wall_samples<Dim>(                                                                \
      const std::vector<Point>&, const std::vector<std::array<int, nodes_of_simplex(Dim - 1, Order)>>&, const Axis&, \
      const std::vector<double>&, int, const SamplingPlace&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

template double axial_position(const std::vector<Point>&, const std::vector<std::array<int, 2>>&, const Axis&);
template double axial_position(const std::vector<Point>&, const std::vector<std::array<int, 3>>&, const Axis&);
template double axial_position(const std::vector<Point>&, const std::vector<std::array<int, 6>>&, const Axis&);

}  // namespace fsi
