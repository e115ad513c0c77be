#include "mesher/surface/square_cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/error.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

struct Plane {
  Point at, normal;  ///< normal towards the opening
  double height(const Point& x) const { return dot(x - at, normal); }
};

/// Nodes beyond a plane that are connected with the opening's rim there.
std::vector<char> beyond(const TriangleSurface& surface, const std::vector<std::vector<int>>& neighbours,
                         const std::vector<int>& rim, const Plane& plane) {
  std::vector<char> is_beyond(surface.nodes.size(), 0);
  std::vector<int> front;
  const auto add = [&](int node) {
    if (is_beyond[node] != 0 || plane.height(surface.nodes[node]) <= 0) return;
    is_beyond[node] = 1;
    front.push_back(node);
  };
  for (const int node : rim) add(node);
  for (std::size_t i = 0; i < front.size(); ++i)
    for (const int next : neighbours[front[i]]) add(next);
  return is_beyond;
}

/// The centre of the line in which the plane cuts the surface at the part's end: of its segments by their lengths.
/// Nothing where it does not cut.
std::optional<Point> section_centre(const TriangleSurface& surface, const std::vector<char>& part, const Plane& plane) {
  Point sum{0, 0, 0};
  double length = 0;
  for (const auto& t : surface.triangles) {
    std::vector<Point> ends;
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if (part[a] == part[b]) continue;
      const double ha = plane.height(surface.nodes[a]), hb = plane.height(surface.nodes[b]);
      ends.push_back(surface.nodes[a] + (ha / (ha - hb)) * (surface.nodes[b] - surface.nodes[a]));
    }
    if (ends.size() != 2) continue;
    const double part_of_it = distance(ends[0], ends[1]);
    sum = sum + (0.5 * part_of_it) * (ends[0] + ends[1]);
    length += part_of_it;
  }
  if (!(length > 0)) return std::nullopt;
  return (1 / length) * sum;
}

/// The plane across the vessel at a distance behind its opening.
class CutFinder {
 public:
  CutFinder(const TriangleSurface& surface, const LumenOpening& opening, std::vector<int> rim)
      : surface_(surface), opening_(opening), rim_(std::move(rim)), neighbours_(all_neighbours(surface)) {}

  Plane at(double distance) const {
    Plane plane{opening_.centre - distance * opening_.normal, opening_.normal};
    const double step = std::min(opening_.diameter() / 4, distance / 2);
    for (int trial = 0; trial < 20; ++trial) {
      const Point middle = centre_of_section(plane);
      const Point before = centre_of_section({middle + step * plane.normal, plane.normal});
      const Point behind = centre_of_section({middle - step * plane.normal, plane.normal});
      const Point normal = (1 / norm(before - behind)) * (before - behind);
      const double turned = norm(normal - plane.normal);
      plane = {middle, normal};
      if (turned < 1e-4) break;
    }
    return plane;
  }

  std::vector<char> beyond_of(const Plane& plane) const { return beyond(surface_, neighbours_, rim_, plane); }

 private:
  /// Those inside too at nodes of rims, unlike neighbours_of().
  static std::vector<std::vector<int>> all_neighbours(const TriangleSurface& surface) {
    std::vector<std::vector<int>> neighbours(surface.nodes.size());
    for (const auto& t : surface.triangles)
      for (int k = 0; k < 3; ++k) {
        neighbours[t[k]].push_back(t[(k + 1) % 3]);
        neighbours[t[k]].push_back(t[(k + 2) % 3]);
      }
    return neighbours;
  }

  Point centre_of_section(const Plane& plane) const {
    const auto found = section_centre(surface_, beyond_of(plane), plane);
    if (!found)
      throw InputError("fsi-mesh", "--cut " + opening_.name,
                       "the plane at " + place_of(plane.at) + " does not cut the vessel off", "give another distance");
    return *found;
  }

  const TriangleSurface& surface_;
  const LumenOpening& opening_;
  std::vector<int> rim_;
  std::vector<std::vector<int>> neighbours_;
};

/// Puts nodes of the cut triangles that are near the plane onto it, lest slivers be left; they are no longer in the
/// part.
void snap(TriangleSurface& surface, std::vector<char>& part, const Plane& plane) {
  constexpr double near = 0.1;  // of the edge
  const std::vector<char> before = part;
  const auto try_to_snap = [&](int node, double edge) {
    const double height = plane.height(surface.nodes[node]);
    if (std::abs(height) > near * edge) return;
    surface.nodes[node] = surface.nodes[node] - height * plane.normal;
    part[node] = 0;
  };
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if (before[a] == before[b]) continue;
      const double edge = distance(surface.nodes[a], surface.nodes[b]);
      try_to_snap(a, edge);
      try_to_snap(b, edge);
    }
}

/// The surface without a part, whose triangles on the plane are cut through.
TriangleSurface without(TriangleSurface surface, std::vector<char> part, const Plane& plane) {
  snap(surface, part, plane);
  TriangleSurface left{surface.nodes, {}};
  std::map<SurfaceEdge, int> crossing;
  const auto between = [&](int gone, int stays) {
    const double above = plane.height(surface.nodes[gone]), below = plane.height(surface.nodes[stays]);
    if (below > -1e-12 * above) return stays;  // on the plane
    const auto [found, is_new] = crossing.try_emplace({gone, stays}, static_cast<int>(left.nodes.size()));
    if (is_new)
      left.nodes.push_back(surface.nodes[gone] +
                           (above / (above - below)) * (surface.nodes[stays] - surface.nodes[gone]));
    return found->second;
  };
  const auto add = [&](const SurfaceTriangle& t) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) left.triangles.push_back(t);
  };
  for (auto t : surface.triangles) {
    const int gone = part[t[0]] + part[t[1]] + part[t[2]];
    if (gone == 3) continue;
    if (gone == 0) {
      add(t);
      continue;
    }
    // Turned so that the one that goes, or the one that stays, comes first.
    const char alone = gone == 1 ? 1 : 0;
    while (part[t[0]] != alone) std::rotate(t.begin(), t.begin() + 1, t.end());
    if (alone == 0) {
      add({t[0], between(t[1], t[0]), between(t[2], t[0])});
    } else {
      const int p = between(t[0], t[1]), q = between(t[0], t[2]);
      add({p, t[1], t[2]});
      add({p, t[2], q});
    }
  }
  return part_of(left, std::vector<char>(left.triangles.size(), 1));
}

}  // namespace

void cut_square(TriangleSurface& surface, LumenOpening& opening, double distance) {
  const auto rims_before = rims_of(surface).size();
  const CutFinder finder(surface, opening, rim_of(surface, opening));
  const Plane plane = finder.at(distance);
  TriangleSurface left = without(surface, finder.beyond_of(plane), plane);
  if (rims_of(left).size() != rims_before)
    throw InputError(
        "fsi-mesh", "--cut " + opening.name,
        "the plane at " + place_of(plane.at) + " does not cut the vessel in one closed line, or cuts another opening",
        "give another distance");
  surface = std::move(left);
  opening.centre = plane.at;
  opening.capped = false;
  rim_of(surface, opening);
}

void flatten_rim(TriangleSurface& surface, LumenOpening& opening) {
  const auto rim = rim_of(surface, opening);
  const LoopPlane plane = plane_of(surface.nodes, rim);
  double edge = 0;
  for (std::size_t i = 0; i < rim.size(); ++i)
    edge += distance(surface.nodes[rim[i]], surface.nodes[rim[(i + 1) % rim.size()]]) / static_cast<double>(rim.size());
  const double allowed = std::max(0.5 * edge, 0.1 * opening.diameter());
  if (plane.off_plane > allowed)
    throw InputError("fsi-mesh", "--opening " + opening.name,
                     fmt::format("its rim at {} is {:.2g} mm off a plane", place_of(plane.centre), plane.off_plane),
                     fmt::format("cut it square: --cut {}={:.2g}, for one", opening.name, 2 * plane.off_plane));
  for (const int node : rim) {
    const double off = dot(surface.nodes[node] - plane.centre, plane.normal);
    surface.nodes[node] = surface.nodes[node] - off * plane.normal;
  }
}

}  // namespace fsi
