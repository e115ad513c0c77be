#include "mesh/flat_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/facets.hpp"
#include "mesh/flat_regions.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_distance.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr const char* program = "fsi-mesh";

/// The region of the fluid, whose boundary is looked at. \throws InputError \param option  for the message
template <int Order>
int fluid_of(const SimplexMesh<3, Order>& mesh, const std::string& option) {
  const int fluid = mesh.region_index(group::fluid);
  if (fluid < 0)
    throw InputError(program, option,
                     fmt::format("names a part of the fluid's surface, and the mesh has no volume fluid{}",
                                 mesh.regions.empty() ? "" : fmt::format(", but {}", fmt::join(mesh.regions, ", "))),
                     "call the lumen's volume fluid: of fsi-mesh import --group fluid=PART; of a wall alone name its "
                     "surfaces by --group");
  return fluid;
}

/// The fluid's boundary and its flat parts.
template <int Order>
struct FlatParts {
  std::vector<BoundaryFacet<3, Order>> facets;
  std::vector<SurfaceTriangle> triangles;
  std::vector<FlatRegion> parts;

  FlatParts(const SimplexMesh<3, Order>& mesh, const std::string& option)
      : facets(boundary_facets(mesh, {fluid_of(mesh, option)})) {
    for (const auto& facet : facets) triangles.push_back({facet.nodes[0], facet.nodes[1], facet.nodes[2]});
    parts = flat_regions(mesh.nodes, triangles);
  }
};

std::string listed(const std::vector<const FlatRegion*>& parts) {
  constexpr std::size_t most = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(parts.size(), most); ++i)
    text += fmt::format("{}{} with normal {} and {:.3g} mm^2", i == 0 ? "" : ", ", place_of(parts[i]->centre),
                        text_of_normal(parts[i]->normal), parts[i]->area);
  return parts.size() > most ? text + fmt::format(", and {} more", parts.size() - most) : text;
}

std::string all_places(const std::vector<FlatRegion>& parts) {
  std::vector<const FlatRegion*> all;
  for (const auto& part : parts) all.push_back(&part);
  return all.empty() ? "the surface has no flat part with a sharp rim" : "flat parts are at " + listed(all);
}

/// Whether half of it or more is: a group may leave out a triangle at the rim, or have one more.
template <int Order>
bool is_named(const FlatParts<Order>& flat, const FlatRegion& part, const std::set<FacetKey<3>>& named) {
  const auto in_groups = std::count_if(part.triangles.begin(), part.triangles.end(),
                                       [&](int t) { return named.count(facet_key<3>(flat.facets[t].nodes)) > 0; });
  return 2 * static_cast<std::size_t>(in_groups) >= part.triangles.size();
}

template <int Order>
std::vector<FlatRegion> unnamed_of(const SimplexMesh<3, Order>& mesh, const FlatParts<Order>& flat) {
  std::set<FacetKey<3>> known;
  for (const auto& group : mesh.facet_groups)
    for (const auto& facet : group.facets) known.insert(facet_key<3>(facet));
  std::vector<int> others;
  for (int r = 0; r < static_cast<int>(mesh.regions.size()); ++r)
    if (mesh.regions[r] != group::fluid) others.push_back(r);
  if (!others.empty())
    for (const auto& facet : boundary_facets(mesh, others)) known.insert(facet_key<3>(facet.nodes));
  std::vector<FlatRegion> unnamed;
  for (const auto& part : flat.parts)
    if (!is_named(flat, part, known)) unnamed.push_back(part);
  return unnamed;
}

/// The flat part that a point is on. \throws InputError \param option  for the message
template <int Order>
std::size_t part_at(const SimplexMesh<3, Order>& mesh, const FlatParts<Order>& flat, const Point& at,
                    const std::string& option) {
  if (flat.parts.empty()) throw InputError(program, option, all_places(flat.parts), "close the lumen by flat caps");
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < flat.parts.size(); ++i)
    for (const int t : flat.parts[i].triangles) {
      const auto& [a, b, c] = flat.triangles[t];
      const double away = distance_to_triangle(at, mesh.nodes[a], mesh.nodes[b], mesh.nodes[c]);
      if (away < least) {
        least = away;
        nearest = i;
      }
    }
  const FlatRegion& part = flat.parts[nearest];
  if (least > part.edge)
    throw InputError(program, option,
                     fmt::format("{} is {:.3g} mm away from the nearest flat part, at {}", place_of(at), least,
                                 place_of(part.centre)),
                     fmt::format("give a point within {:.2g} mm of one; ", part.edge) + all_places(flat.parts));
  return nearest;
}

}  // namespace

std::string place_of(const Point& at) {
  const Point x = without_rounding(at);
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", x[0], x[1], x[2]);
}

std::string text_of_normal(const Point& normal) {
  std::string text;
  for (const double c : normal) text += fmt::format("{}{:.3g}", text.empty() ? "" : ", ", std::abs(c) < 5e-4 ? 0.0 : c);
  return "(" + text + ")";
}

template <int Order>
std::string places_of_flat_parts(const SimplexMesh<3, Order>& mesh) {
  return all_places(FlatParts<Order>(mesh, "--opening").parts);
}

template <int Order>
void name_flat_parts(SimplexMesh<3, Order>& mesh, const std::vector<FlatPart>& wanted) {
  if (wanted.empty()) return;
  const FlatParts<Order> flat(mesh, "--opening " + wanted.front().name);
  std::map<std::size_t, std::string> taken;
  for (const auto& part : wanted) {
    const std::string option = "--opening " + part.name;
    if (mesh.facets(part.name) != nullptr)
      throw InputError(program, option, "the mesh has a surface of this name", "leave it out, or give another name");
    const std::size_t found = part_at(mesh, flat, part.at, option);
    if (const auto [other, is_new] = taken.try_emplace(found, part.name); !is_new)
      throw InputError(program, option, "is the same part of the surface as " + other->second,
                       "give a point on the other one: " + all_places(flat.parts));
    typename SimplexMesh<3, Order>::FacetGroup group{part.name, {}};
    for (const int t : flat.parts[found].triangles) group.facets.push_back(flat.facets[t].nodes);
    mesh.facet_groups.push_back(std::move(group));
  }
}

template <int Order>
std::vector<FlatRegion> unnamed_flat_parts(const SimplexMesh<3, Order>& mesh) {
  return unnamed_of(mesh, FlatParts<Order>(mesh, "--opening"));
}

template <int Order>
std::string name_flat_ends(SimplexMesh<3, Order>& mesh) {
  const std::string option = "--flat-ends";
  const FlatParts<Order> flat(mesh, option);
  std::vector<std::string> said;
  int number = 0;
  for (const auto& part : unnamed_of(mesh, flat)) {
    std::string name;
    do name = fmt::format("end_{}", ++number);
    while (mesh.facets(name) != nullptr);
    typename SimplexMesh<3, Order>::FacetGroup group{name, {}};
    for (const int t : part.triangles) group.facets.push_back(flat.facets[t].nodes);
    mesh.facet_groups.push_back(std::move(group));
    said.push_back(fmt::format("{}, {:.4g} mm^2 at {}", name, part.area, place_of(part.centre)));
  }
  if (said.empty())
    throw InputError(program, option,
                     flat.parts.empty() ? "the fluid's surface has no flat part with a sharp rim"
                                        : "each flat part of the fluid's surface has a name, or is a side of the wall",
                     "leave the option out, or name surfaces by --group");
  return fmt::format("Flat ends: {}.\n", fmt::join(said, "; "));
}

template <int Order>
void require_flat_parts_named(const SimplexMesh<3, Order>& mesh, const std::vector<Point>& closed) {
  const FlatParts<Order> flat(mesh, "--closed");
  std::set<std::size_t> known;
  for (const Point& at : closed) known.insert(part_at(mesh, flat, at, "--closed"));
  std::set<FacetKey<3>> named;
  for (const auto& group : mesh.facet_groups)
    if (group.name != group::inner)
      for (const auto& facet : group.facets) named.insert(facet_key<3>(facet));
  std::vector<const FlatRegion*> forgotten;
  for (std::size_t i = 0; i < flat.parts.size(); ++i) {
    if (known.count(i) == 0 && !is_named(flat, flat.parts[i], named)) forgotten.push_back(&flat.parts[i]);
  }
  if (forgotten.empty()) return;
  throw InputError(
      program, "--opening",
      fmt::format("{} without a name: {}", forgotten.size() == 1 ? "a flat part is" : "flat parts are",
                  listed(forgotten)),
      "name each opening by --opening NAME=X,Y,Z, a point on it; say --closed X,Y,Z of a flat part of the wall");
}

template void name_flat_parts(SimplexMesh<3, 1>&, const std::vector<FlatPart>&);
template void name_flat_parts(SimplexMesh<3, 2>&, const std::vector<FlatPart>&);
template std::vector<FlatRegion> unnamed_flat_parts(const SimplexMesh<3, 1>&);
template std::vector<FlatRegion> unnamed_flat_parts(const SimplexMesh<3, 2>&);
template std::string name_flat_ends(SimplexMesh<3, 1>&);
template std::string name_flat_ends(SimplexMesh<3, 2>&);
template void require_flat_parts_named(const SimplexMesh<3, 1>&, const std::vector<Point>&);
template std::string places_of_flat_parts(const SimplexMesh<3, 1>&);
template std::string places_of_flat_parts(const SimplexMesh<3, 2>&);

}  // namespace fsi
