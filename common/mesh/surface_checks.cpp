#include "mesh/surface_checks.hpp"

#include <cmath>
#include <numeric>

#include "mesh/for_each_mesh.hpp"

namespace fsi {

namespace {

template <int Dim, int Order>
class SurfaceChecks {
  using Facet = typename SimplexMesh<Dim, Order>::Facet;
  using FacetSet = typename CheckedMesh<Dim, Order>::FacetSet;
  using Words = CellWords<Dim>;
  using Plane = SymmetryPlane<Dim, Order>;
  static constexpr const char* one_mesh_remedy =
      Dim == 3 ? "save surfaces and volumes of one conforming mesh" : "save curves and surfaces of one conforming mesh";

 public:
  explicit SurfaceChecks(const CheckedMesh<Dim, Order>& checked) : checked_(checked) {}

  void surfaces() const {
    const std::string wall = "the wall";
    if (checked_.needs.inlet || checked_.needs.outlet) {
      surface(group::inlet, {checked_.fluid}, "the fluid", checked_.needs.inlet);
      surface(group::outlet, {checked_.fluid}, "the fluid", checked_.needs.outlet);
      disjoint(group::inlet, group::outlet);
    }
    without_astray_elements(checked_.needs.openings);
    for (std::size_t i = 0; i < checked_.needs.openings.size(); ++i) {
      surface(checked_.needs.openings[i], {checked_.fluid}, "the fluid", true);
      for (std::size_t j = 0; j < i; ++j)
        disjoint(checked_.needs.openings[j].c_str(), checked_.needs.openings[i].c_str());
    }
    if (!checked_.layers.empty()) {
      without_astray_elements(checked_.needs.supports);
      const bool ends_needed =
          checked_.held_by_wall_ends_alone() && checked_.planes.empty() && !checked_.held_by_inertia();
      surface(group::wall_ends, checked_.layers, wall, ends_needed);
      surface(group::outer, checked_.layers, wall, false);
      if (checked_.needs.inner_surface) surface(group::inner, checked_.layers, wall, true);
      for (const auto& name : checked_.needs.supports) surface(name, checked_.layers, wall, true);
    }
    symmetry();
    straight_axis();
  }

 private:
  /// Without its elements that are facets of no cell a surface would be smaller than in the file.
  void without_astray_elements(const std::vector<std::string>& names) const {
    for (const auto& group : checked_.mesh.facet_groups)
      if (!group.astray.empty() && std::find(names.begin(), names.end(), group.name) != names.end())
        checked_.fail(group.name, group.astray, one_mesh_remedy);
  }

  /// A surface group that the scene needs, or that is there: each facet must bound a cell of `regions`, with nothing
  /// behind it.
  void surface(const std::string& name, const std::vector<int>& regions, const std::string& owner,
               bool required) const {
    const auto* facets = checked_.mesh.facets(name);
    if (facets == nullptr || facets->empty()) {
      if (required)
        checked_.fail(name, fmt::format("the {} is missing or empty", Words::facet_group),
                      checked_.other_name_for(name, regions) +
                          fmt::format("name the {} of {} in gmsh, e.g. {}(\"{}\") = {{1}};",
                                      Dim == 3 ? "faces" : "sides", owner, Words::facet_command, name));
      return;
    }
    const auto is_in = [&](int cell) {
      return cell >= 0 && std::find(regions.begin(), regions.end(), checked_.mesh.cell_region[cell]) != regions.end();
    };
    std::size_t foreign = 0, within = 0;
    const Facet* first = nullptr;
    for (const auto& facet : *facets) {
      const auto* cells = checked_.cells_of(facet_key<Dim>(facet));
      if (!cells)
        checked_.fail(name,
                      fmt::format("the {} at {} is no facet of a {}", Words::facet,
                                  checked_.text(checked_.centroid(facet)), Words::cell),
                      one_mesh_remedy);
      const int a = cells->first, b = cells->second;
      const bool bad_owner = !is_in(a) && !is_in(b), bad_side = !bad_owner && b >= 0;
      foreign += bad_owner;
      within += bad_side;
      if ((bad_owner || bad_side) && first == nullptr) first = &facet;
    }
    if (foreign > 0)
      checked_.fail(name,
                    fmt::format("{} of {} {} do not bound {}, the first at {}", foreign, facets->size(), Words::facets,
                                owner, checked_.text(checked_.centroid(*first))),
                    fmt::format("put {} of {} only into this group", Dim == 3 ? "faces" : "sides", owner));
    if (within > 0)
      checked_.fail(
          name,
          fmt::format("{} of {} {} lie between two {}, the first at {}", within, facets->size(), Words::facets,
                      Words::cells, checked_.text(checked_.centroid(*first))),
          fmt::format("put {} on the outside of the mesh only into this group", Dim == 3 ? "faces" : "sides"));
  }

  /// No facet in both of two groups.
  void disjoint(const char* first, const char* second) const {
    const auto *some = checked_.mesh.facets(first), *others = checked_.mesh.facets(second);
    if (some == nullptr || others == nullptr) return;
    FacetSet keys;
    for (const auto& facet : *some) keys.insert(facet_key<Dim>(facet));
    for (const auto& facet : *others)
      if (keys.count(facet_key<Dim>(facet)))
        checked_.fail(
            second,
            fmt::format("the {} at {} is in {}, too", Words::facet, checked_.text(checked_.centroid(facet)), first),
            fmt::format("put every {} into one of the two groups only", Dim == 3 ? "face" : "side"));
  }

  void symmetry() const {
    std::vector<int> all(checked_.mesh.regions.size());
    std::iota(all.begin(), all.end(), 0);
    for (const auto& plane : checked_.planes) {
      const std::string& name = plane.group->name;
      const auto axis = std::find(group::symmetry.begin(), group::symmetry.end(), name) - group::symmetry.begin();
      if (Dim == 2 && axis == (checked_.axisymmetric() ? 1 : 2))
        checked_.fail(name, "the mesh lies in this plane itself",
                      checked_.axisymmetric()
                          ? "planes normal to the axis are symmetry_z; r is along x, the axis along z"
                          : "sides of a plane mesh are symmetry_x or symmetry_y");
      surface(name, all, "fluid or wall", false);
      if (axis < 3)
        normal_to(static_cast<int>(axis), plane);
      else
        flat(plane);
      disjoint(group::inlet, name.c_str());
      disjoint(group::outlet, name.c_str());
      for (const auto& opening : checked_.needs.openings) disjoint(opening.c_str(), name.c_str());
    }
  }

  /// Facets that may lie in several planes normal to one axis.
  void normal_to(int axis, const Plane& plane) const {
    const double flat_to = flatness();
    for (const auto& facet : plane.group->facets) {
      double low = checked_.mesh.nodes[facet[0]][axis], high = low;
      for (const int node : facet) {
        low = std::min(low, checked_.mesh.nodes[node][axis]);
        high = std::max(high, checked_.mesh.nodes[node][axis]);
      }
      if (high - low > flat_to)
        checked_.fail(
            plane.group->name,
            fmt::format("the {} at {} does not lie in a plane normal to {}: its nodes are {:.3g} mm apart along it",
                        Words::facet, checked_.text(checked_.centroid(facet)), "xyz"[axis], high - low),
            "put flat faces normal to this axis only into this group, and other planes into symmetry_1, symmetry_2 "
            "and so on");
    }
  }

  /// Facets that define a plane themselves.
  void flat(const Plane& plane) const {
    const auto& [group, normal] = plane;
    if (Dim == 2 && checked_.axisymmetric() && normal[0] != 0)
      checked_.fail(group->name, "its sides are not normal to the axis: turned about it they are no plane",
                    "put sides of one height only into this group");
    double mean = 0, count = 0;
    for (const auto& facet : group->facets)
      for (const int node : facet) {
        mean += dot(normal, checked_.mesh.nodes[node]);
        ++count;
      }
    mean /= count;
    double furthest = 0;
    const Facet* worst = nullptr;
    for (const auto& facet : group->facets)
      for (const int node : facet)
        if (const double off = std::abs(dot(normal, checked_.mesh.nodes[node]) - mean); off > furthest) {
          furthest = off;
          worst = &facet;
        }
    if (furthest > flatness())
      checked_.fail(group->name,
                    fmt::format("its {} do not lie in one plane: the one at {} is {:.3g} mm off their mean plane",
                                Words::facets, checked_.text(checked_.centroid(*worst)), furthest),
                    "put each plane into a group of its own: symmetry_1, symmetry_2 and so on");
  }

  /// How far off its plane a node may lie, mm. Looks at all nodes.
  double flatness() const { return 1e-6 * checked_.size(); }

  /// A side of quadratic triangles that runs from axis to axis beside it would be a wall.
  void straight_axis() const {
    if constexpr (Dim == 2 && Order == 2) {
      if (checked_.needs.geometry != TriangleGeometry::axisymmetric) return;
      for (const auto& cell : checked_.mesh.cells)
        for (const auto& facet : outward_facets<Dim, Order>(cell))
          if (checked_.mesh.nodes[facet[0]][0] == 0 && checked_.mesh.nodes[facet[1]][0] == 0 &&
              checked_.mesh.nodes[facet[2]][0] != 0)
            checked_.fail(fmt::format("node at {}", checked_.text(checked_.mesh.nodes[facet[2]])),
                          "is off the axis between two nodes on it", "give the axis straight sides with r = 0");
    }
  }

  const CheckedMesh<Dim, Order>& checked_;
};

}  // namespace

template <int Dim, int Order>
void check_surfaces(const CheckedMesh<Dim, Order>& checked) {
  SurfaceChecks<Dim, Order>(checked).surfaces();
}

#define INSTANTIATE(Dim, Order) template void check_surfaces(const CheckedMesh<Dim, Order>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
