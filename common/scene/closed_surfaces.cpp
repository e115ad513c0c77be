#include "scene/closed_surfaces.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <utility>

#include "base/error.hpp"
#include "base/names.hpp"
#include "case/openings.hpp"
#include "mesh/boundary.hpp"
#include "mesh/facets.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

/// Facets of the fluid's boundary, and what is said of each.
template <int Dim, int Order>
class FluidFacets {
  using Mesh = SimplexMesh<Dim, Order>;
  using Facet = typename Mesh::Facet;
  using Group = typename Mesh::FacetGroup;

 public:
  /// Those shared with the wall and on the axis of revolution bound nothing that could be open.
  FluidFacets(const Mesh& mesh, const SceneMeshNeeds& needs) : mesh_(mesh) {
    const int fluid = mesh.region_index(group::fluid);
    for (const auto& facet : boundary_facets(mesh, {fluid})) said_[facet_key<Dim>(facet.nodes)] = false;
    std::vector<int> layers;
    for (const auto& layer : needs.layers) layers.push_back(mesh.region_index(layer));
    for (const auto& facet : interface_facets(mesh, fluid, layers)) said_.erase(facet_key<Dim>(facet));
    if (Dim == 3 || needs.geometry != TriangleGeometry::axisymmetric) return;
    for (auto facet = said_.begin(); facet != said_.end();) {
      const bool on_axis =
          std::all_of(facet->first.begin(), facet->first.end(), [&](int node) { return mesh_.nodes[node][0] == 0; });
      facet = on_axis ? said_.erase(facet) : std::next(facet);
    }
  }

  /// \return how many of the group's facets are there and were not said yet
  std::size_t say(const Group& group) {
    std::size_t count = 0;
    for (const auto& facet : group.facets)
      if (const auto found = said_.find(facet_key<Dim>(facet)); found != said_.end()) {
        count += found->second ? 0 : 1;
        found->second = true;
      }
    return count;
  }

  /// Size and place of what is said nowhere of a group; empty when there is nothing.
  std::string unsaid(const Group& group) const {
    double area = 0;
    Point centre{0, 0, 0};
    for (const auto& facet : group.facets) {
      const auto found = said_.find(facet_key<Dim>(facet));
      if (found == said_.end() || found->second) continue;
      const double size = size_of(facet);
      area += size;
      for (int i = 0; i < Dim; ++i) centre = centre + (size / Dim) * mesh_.nodes[facet[i]];
    }
    if (!(area > 0)) return "";
    return fmt::format("{} ({:.3g} {}, about {})", group.name, area, Dim == 3 ? "mm^2" : "mm",
                       place_of((1 / area) * centre));
  }

 private:
  double size_of(const Facet& f) const {
    if constexpr (Dim == 3)
      return norm(triangle_area_vector(mesh_.nodes[f[0]], mesh_.nodes[f[1]], mesh_.nodes[f[2]]));
    else
      return distance(mesh_.nodes[f[0]], mesh_.nodes[f[1]]);
  }

  const Mesh& mesh_;
  std::unordered_map<FacetKey<Dim>, bool, FacetKeyHash> said_;
};

/// What the case says to be closed: its list, and an outlet that it says not to be one.
std::vector<std::string> closed_names(const Case& setup) {
  std::vector<std::string> names = setup.fluid->closed.value_or(std::vector<std::string>{});
  if (!setup.fluid->outlet && setup.openings.count(group::outlet) == 0 && !contains(names, group::outlet))
    names.emplace_back(group::outlet);
  return names;
}

std::string in_quotes(const std::vector<std::string>& names) {
  return "\"" + fmt::format("{}", fmt::join(names, "\", \"")) + "\"";
}

[[noreturn]] void refuse_unsaid(const Case& setup, const std::vector<std::string>& names,
                                const std::vector<std::string>& places, const std::string& mesh) {
  auto all = setup.fluid->closed.value_or(std::vector<std::string>{});
  all.insert(all.end(), names.begin(), names.end());
  const bool one = names.size() == 1;
  throw InputError(setup.path.string(), "opening",
                   fmt::format("the mesh {} names {} of the fluid that the case does not: {}", mesh,
                               one ? "a surface" : "surfaces", fmt::join(places, ", ")),
                   fmt::format("give {} an [[opening]], or say closed = [{}] in [fluid] if the fluid sticks there",
                               one ? "it" : "each", in_quotes(all)));
}

}  // namespace

template <int Dim, int Order>
std::vector<std::string> open_and_closed_surfaces(const Case& setup, const SimplexMesh<Dim, Order>& mesh,
                                                  const SceneMeshNeeds& needs, const std::string& name) {
  if (!setup.fluid) return {};
  FluidFacets<Dim, Order> facets(mesh, needs);
  std::vector<std::string> known, free, closed, open;
  for (const auto& opening : openings_of(setup)) {
    open.push_back(opening.surface);
    if (mesh.facets(opening.surface) && opening.is_free()) free.push_back(opening.surface);
  }
  const auto to_close = closed_names(setup);
  for (const auto& group : mesh.facet_groups) {
    known.push_back(group.name);
    if (contains(open, group.name) || group::is_symmetry_plane(group.name)) facets.say(group);
  }
  for (const auto& group : mesh.facet_groups) {
    if (!contains(to_close, group.name)) continue;
    const bool listed = setup.fluid->closed && contains(*setup.fluid->closed, group.name);
    if (facets.say(group) > 0)
      closed.push_back(group.name);
    else if (listed)
      throw InputError(setup.path.string(), "fluid.closed",
                       fmt::format("\"{}\" is no surface of the fluid alone in the mesh {}", group.name, name),
                       "leave it out: it is shared with the wall, or part of an opening");
  }
  if (setup.fluid->closed)
    for (const auto& wanted : *setup.fluid->closed)
      if (!contains(known, wanted))
        throw InputError(setup.path.string(), "fluid.closed",
                         fmt::format("the mesh {} has no surface \"{}\" on the volumes of the scene", name, wanted),
                         known.empty() ? "leave it out: the mesh names no surface" : name_remedy(wanted, known));
  for (const auto& group : mesh.facet_groups)
    if (group::is_no_opening(group.name)) facets.say(group);
  std::vector<std::string> names, places;
  for (const auto& group : mesh.facet_groups)
    if (const auto place = facets.unsaid(group); !place.empty()) {
      names.push_back(group.name);
      places.push_back(place);
    }
  if (!names.empty()) refuse_unsaid(setup, names, places, name);
  std::vector<std::string> lines;
  if (!free.empty()) lines.push_back(fmt::format("free of traction: {}", fmt::join(free, ", ")));
  if (!closed.empty()) lines.push_back(fmt::format("closed, the fluid sticks there: {}", fmt::join(closed, ", ")));
  return lines;
}

// Numbers as template arguments: parentheses would only hide them.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define INSTANTIATE(Dim, Order)                                                                           \
  template std::vector<std::string> open_and_closed_surfaces(const Case&, const SimplexMesh<Dim, Order>&, \
                                                             const SceneMeshNeeds&, const std::string&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fsi
