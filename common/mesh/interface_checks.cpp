#include "mesh/interface_checks.hpp"

#include <cmath>
#include <iterator>

#include "mesh/boundary.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/point_distance.hpp"

namespace fsi {

namespace {

template <int Dim, int Order>
class InterfaceChecks {
  using Facet = typename SimplexMesh<Dim, Order>::Facet;
  using FacetSet = typename CheckedMesh<Dim, Order>::FacetSet;

 public:
  explicit InterfaceChecks(const CheckedMesh<Dim, Order>& checked) : checked_(checked) {}

  void interface() const {
    const auto shared = interface_facets(checked_.mesh, checked_.fluid, checked_.layers);
    if (shared.empty())
      checked_.fail("interface", "the wall does not touch the fluid: they share no facet", conforming_remedy);
    faces_that_meet_unshared();

    std::vector<Facet> held;
    checked_.for_groups_and_planes(checked_.needs.clamping,
                                   [&](const auto& facets) { held.insert(held.end(), facets.begin(), facets.end()); });
    const auto clamped = facet_nodes(held), free = free_rims(shared);
    // An interface that ends on the axis is closed there.
    const auto on_axis = [&](int node) {
      return Dim == 2 && checked_.needs.geometry == TriangleGeometry::axisymmetric && checked_.mesh.nodes[node][0] == 0;
    };
    std::size_t loose = 0;
    int first = -1;
    for (const int node : rim_nodes<Dim>(shared)) {
      if (on_axis(node) || std::binary_search(clamped.begin(), clamped.end(), node)) continue;
      if (std::binary_search(free.begin(), free.end(), node)) continue;
      ++loose;
      if (first < 0) first = node;
    }
    if (loose > 0)
      checked_.fail(
          group::wall_ends,
          fmt::format("the rim of the interface is not clamped: {} of its nodes are not in this group, the first at {}",
                      loose, checked_.text(checked_.mesh.nodes[first])),
          checked_.left_out_volumes() + checked_.other_name_for(group::wall_ends, checked_.layers) +
              std::string(std::find(checked_.needs.clamping.begin(), checked_.needs.clamping.end(), group::wall_ends) !=
                                  checked_.needs.clamping.end()
                              ? ""
                              : "fix all components of its support (only ends that a support names and that meet the "
                                "fluid in an "
                                "opening can slide or be free), or ") +
              "put both end faces of all wall layers into it, or planes of symmetry into symmetry_x, symmetry_y, "
              "symmetry_z, or symmetry_1 and so on");
  }

 private:
  /// Nodes where the wall may move although the interface ends there: in surfaces that supports name, where an opening
  /// begins that can follow them, and no face that the fluid sticks to.
  std::vector<int> free_rims(const std::vector<Facet>& shared) const {
    if (checked_.needs.supports.empty()) return {};
    std::vector<std::string> open = checked_.needs.openings;
    if (checked_.needs.inlet) open.emplace_back(group::inlet);
    if (checked_.needs.outlet) open.emplace_back(group::outlet);
    const auto nodes_of = [&](const std::vector<std::string>& names) {
      std::vector<Facet> facets;
      for (const auto& name : names)
        if (const auto* group = checked_.mesh.facets(name)) facets.insert(facets.end(), group->begin(), group->end());
      return facet_nodes(facets);
    };
    FacetSet passable;
    for (const auto& facet : shared) passable.insert(facet_key<Dim>(facet));
    checked_.for_groups_and_planes(open, [&](const auto& facets) {
      for (const auto& facet : facets) passable.insert(facet_key<Dim>(facet));
    });
    std::vector<Facet> sticking;
    for (const auto& facet : boundary_facets(checked_.mesh, {checked_.fluid})) {
      const auto on_axis = [&](int node) { return checked_.axisymmetric() && checked_.mesh.nodes[node][0] == 0; };
      if (passable.count(facet_key<Dim>(facet.nodes)) || std::all_of(facet.nodes.begin(), facet.nodes.end(), on_axis))
        continue;
      sticking.push_back(facet.nodes);
    }
    const auto named = nodes_of(checked_.needs.supports), at_openings = nodes_of(open), stuck = facet_nodes(sticking);
    std::vector<int> in_both, free;
    std::set_intersection(named.begin(), named.end(), at_openings.begin(), at_openings.end(),
                          std::back_inserter(in_both));
    std::set_difference(in_both.begin(), in_both.end(), stuck.begin(), stuck.end(), std::back_inserter(free));
    return free;
  }

  /// Refuses free faces of fluid and wall that lie on each other: they look like an interface and act as two walls.
  void faces_that_meet_unshared() const {
    const auto free_faces = [&](const std::vector<int>& regions, const std::vector<const char*>& named) {
      FacetSet skip;
      for (const char* name : named)
        checked_.for_groups_and_planes({name}, [&](const auto& facets) {
          for (const auto& facet : facets) skip.insert(facet_key<Dim>(facet));
        });
      std::vector<Facet> faces;
      for (const auto& facet : boundary_facets(checked_.mesh, regions))
        if (const auto key = facet_key<Dim>(facet.nodes); checked_.cells_of(key)->second < 0 && !skip.count(key))
          faces.push_back(facet.nodes);
      return faces;
    };
    const auto fluid = free_faces({checked_.fluid}, {group::inlet, group::outlet});
    if (fluid.empty()) return;
    const auto wall = free_faces(checked_.layers, {group::wall_ends, group::outer});

    // Sorted along x, so that a facet is compared with those near it only.
    struct Placed {
      double x;
      Point centre;
      double size;
      Facet facet;
    };
    const auto placed = [&](const Facet& f) {
      const Point centre = checked_.centroid(f);
      return Placed{centre[0], centre, longest_edge(f), f};
    };
    std::vector<Placed> walls;
    double largest = 0;
    for (const auto& f : wall) {
      walls.push_back(placed(f));
      largest = std::max(largest, walls.back().size);
    }
    std::sort(walls.begin(), walls.end(), [](const Placed& a, const Placed& b) { return a.x < b.x; });
    // Of edges the vector along them, which turns with the normal: only angles count here.
    const auto area = [&](const Facet& f) {
      if constexpr (Dim == 3)
        return triangle_area_vector(checked_.mesh.nodes[f[0]], checked_.mesh.nodes[f[1]], checked_.mesh.nodes[f[2]]);
      else
        return checked_.mesh.nodes[f[1]] - checked_.mesh.nodes[f[0]];
    };
    const auto distance_to = [&](const Point& x, const Facet& f) {
      if constexpr (Dim == 3)
        return distance_to_triangle(x, checked_.mesh.nodes[f[0]], checked_.mesh.nodes[f[1]], checked_.mesh.nodes[f[2]]);
      else
        return distance_to_segment(x, checked_.mesh.nodes[f[0]], checked_.mesh.nodes[f[1]]);
    };
    for (const auto& f : fluid) {
      const auto here = placed(f);
      const Point normal = area(f);
      const double reach = largest + here.size;
      auto it = std::lower_bound(walls.begin(), walls.end(), here.x - reach,
                                 [](const Placed& a, double x) { return a.x < x; });
      for (; it != walls.end() && it->x <= here.x + reach; ++it) {
        const Point other = area(it->facet);
        if (dot(normal, other) > -0.7 * norm(normal) * norm(other)) continue;  // not face to face
        const double gap = distance_to(here.centre, it->facet);
        if (gap > 0.1 * std::min(here.size, it->size)) continue;  // two facetings of one curved face are this close
        checked_.fail("interface",
                      fmt::format("at {} {} of fluid and {} lie on each other without sharing nodes (hanging nodes)",
                                  checked_.text(here.centre), Dim == 3 ? "faces" : "sides",
                                  checked_.region_of(checked_.cells_of(facet_key<Dim>(it->facet))->first)),
                      conforming_remedy);
      }
    }
  }

  /// Between two vertices of a facet.
  double longest_edge(const Facet& f) const {
    double longest = 0;
    for (int i = 0; i < Dim; ++i)
      longest = std::max(longest, distance(checked_.mesh.nodes[f[i]], checked_.mesh.nodes[f[(i + 1) % Dim]]));
    return longest;
  }

  const CheckedMesh<Dim, Order>& checked_;
};

}  // namespace

template <int Dim, int Order>
void check_interface(const CheckedMesh<Dim, Order>& checked) {
  InterfaceChecks<Dim, Order>(checked).interface();
}

#define INSTANTIATE(Dim, Order) template void check_interface(const CheckedMesh<Dim, Order>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
