#include "mesh/flat_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

using Edge = std::pair<int, int>;

/// Parts of a closed surface between sharp edges.
struct Parts {
  std::vector<int> of;        ///< per triangle
  std::vector<Point> normal;  ///< unit, mean
  std::vector<Point> centre;  ///< mm
  std::vector<double> bent;   ///< degrees, of the triangle that is furthest out of the mean normal
};

double degrees_between(const Point& a, const Point& b) {
  const double pi = std::acos(-1.0);
  return std::atan2(norm(cross(a, b)), dot(a, b)) * 180 / pi;
}

template <int Order>
Parts parts_of(const SimplexMesh<3, Order>& mesh, const std::vector<BoundaryFacet<3, Order>>& facets) {
  constexpr double sharp = 30;
  std::vector<std::array<int, 3>> triangles;
  for (const auto& facet : facets) triangles.push_back({facet.nodes[0], facet.nodes[1], facet.nodes[2]});
  std::vector<Point> normals;
  std::map<Edge, std::vector<int>> at_edge;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    normals.push_back(triangle_area_vector(mesh.nodes[a], mesh.nodes[b], mesh.nodes[c]));
    for (int k = 0; k < 3; ++k)
      at_edge[std::minmax(triangles[t][k], triangles[t][(k + 1) % 3])].push_back(static_cast<int>(t));
  }
  Parts parts;
  parts.of.assign(triangles.size(), -1);
  for (std::size_t start = 0; start < triangles.size(); ++start) {
    if (parts.of[start] >= 0) continue;
    const int part = static_cast<int>(parts.normal.size());
    std::vector<int> members{static_cast<int>(start)};
    parts.of[start] = part;
    for (std::size_t i = 0; i < members.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const auto& t = triangles[members[i]];
        for (const int next : at_edge[std::minmax(t[k], t[(k + 1) % 3])])
          if (parts.of[next] < 0 && degrees_between(normals[members[i]], normals[next]) < sharp) {
            parts.of[next] = part;
            members.push_back(next);
          }
      }
    Point normal{0, 0, 0}, centre{0, 0, 0};
    double area = 0;
    for (const int t : members) {
      normal = normal + normals[t];
      const double weight = norm(normals[t]);
      area += weight;
      for (const int node : triangles[t]) centre = centre + (weight / 3) * mesh.nodes[node];
    }
    double bent = 0;
    for (const int t : members) bent = std::max(bent, degrees_between(normals[t], normal));
    parts.normal.push_back((1 / norm(normal)) * normal);
    parts.centre.push_back((1 / area) * centre);
    parts.bent.push_back(bent);
  }
  return parts;
}

constexpr double flat = 5;  // degrees

std::string flat_places(const Parts& parts) {
  std::string places;
  int shown = 0;
  for (std::size_t i = 0; i < parts.centre.size(); ++i)
    if (parts.bent[i] < flat && ++shown <= 6) places += (places.empty() ? "" : ", ") + place_of(parts.centre[i]);
  return places.empty() ? "the surface has no flat part with sharp edges" : "flat parts are at " + places;
}

}  // namespace

std::string place_of(Point x) {
  for (double& c : x)
    if (std::abs(c) < 1e-9) c = 0;  // rounding
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", x[0], x[1], x[2]);
}

template <int Order>
std::string places_of_flat_parts(const SimplexMesh<3, Order>& mesh) {
  return flat_places(parts_of(mesh, boundary_facets(mesh, {mesh.region_index(group::fluid)})));
}

template <int Order>
void name_flat_parts(SimplexMesh<3, Order>& mesh, const std::vector<FlatPart>& wanted) {
  if (wanted.empty()) return;
  const auto facets = boundary_facets(mesh, {mesh.region_index(group::fluid)});
  const Parts parts = parts_of(mesh, facets);
  std::map<int, std::string> taken;
  for (const auto& part : wanted) {
    if (mesh.facets(part.name) != nullptr)
      throw InputError("fsi-mesh", "--opening " + part.name, "the mesh has a surface of this name",
                       "leave it out, or give another name");
    int nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < facets.size(); ++t)
      for (const int node : facets[t].nodes) {
        const double away = distance(mesh.nodes[node], part.at);
        if (parts.bent[parts.of[t]] < flat && away < least) {
          least = away;
          nearest = parts.of[t];
        }
      }
    if (nearest < 0)
      throw InputError("fsi-mesh", "--opening " + part.name, flat_places(parts), "close the lumen by flat caps");
    if (const auto [other, is_new] = taken.try_emplace(nearest, part.name); !is_new)
      throw InputError("fsi-mesh", "--opening " + part.name, "is the same part of the surface as " + other->second,
                       "give a point nearer to the other one: " + flat_places(parts));
    typename SimplexMesh<3, Order>::FacetGroup group{part.name, {}};
    for (std::size_t t = 0; t < facets.size(); ++t)
      if (parts.of[t] == nearest) group.facets.push_back(facets[t].nodes);
    mesh.facet_groups.push_back(std::move(group));
  }
}

template void name_flat_parts(SimplexMesh<3, 1>&, const std::vector<FlatPart>&);
template void name_flat_parts(SimplexMesh<3, 2>&, const std::vector<FlatPart>&);
template std::string places_of_flat_parts(const SimplexMesh<3, 1>&);
template std::string places_of_flat_parts(const SimplexMesh<3, 2>&);

}  // namespace fsi
