#include "sampling/wall_sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "math/pi.hpp"
#include "mesh/boundary.hpp"
#include "mesh/cell_map.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/point_math.hpp"
#include "sampling/sampling_rules.hpp"

namespace fsi {

namespace {

double wrapped(double angle) {
  return angle - 2 * pi * std::round(angle / (2 * pi));
}

/// A facet of a tube's surface with its nodes' angles and axial positions.
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
    if (high - low > pi) return {};  // the facet contains the axis
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

/// Angles at which the mean of samples is that over the whole tube.
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
      sampling_remedy);
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
    std::array<double, Nodes> s;  // mm around the tube, from the angle
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
    const bool holds = *std::min_element(place.begin(), place.end()) >= barycentric_inside;
    const auto kept = holds ? place : clamped_weights(place);
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

/// Place along a straight or quadratic edge, 0 to 1, at which its axial position is nearest to z.
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

/// Interpolation at one position on the edges of an axisymmetric surface.
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
    if (away <= -barycentric_inside * length) break;
  }
  if (!(least <= allowed)) no_surface(z, 0, from);
  return best;
}

}  // namespace

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

std::vector<Point> points_on_axis(const Axis& axis, const std::vector<double>& positions) {
  const AxisFrame frame(axis);
  std::vector<Point> points;
  for (const double z : positions) points.push_back(frame.origin + z * frame.along);
  return points;
}

// Numbers as template arguments: parentheses would only hide them.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define INSTANTIATE(Dim, Order)                                                                                      \
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
