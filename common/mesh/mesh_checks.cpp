#include "mesh/mesh_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/error.hpp"
#include "base/names.hpp"
#include "mesh/boundary.hpp"
#include "mesh/cell_words.hpp"
#include "mesh/curved_cells.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/facets.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_distance.hpp"
#include "mesh/point_math.hpp"
#include "mesh/symmetry_planes.hpp"

namespace fsi {

namespace {

constexpr const char* conforming_remedy =
    "mesh fluid and wall together, with one shared surface (gmsh: BooleanFragments or Coherence before meshing)";

std::string text(const Point& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
}

template <int Dim, int Order>
class Checks {
  using Mesh = SimplexMesh<Dim, Order>;
  using Facet = typename Mesh::Facet;
  using Key = FacetKey<Dim>;
  using FacetSet = std::unordered_set<Key, FacetKeyHash>;
  using Words = CellWords<Dim>;
  using Plane = SymmetryPlane<Dim, Order>;

 public:
  Checks(const Mesh& mesh, const SceneMeshNeeds& needs, const std::string& file)
      : mesh_(mesh), needs_(needs), file_(file), planes_(symmetry_planes(mesh)) {}

  void run() {
    volumes();
    same_place();
    curved_cells();
    facets_of_cells();
    surfaces();
    fluid_in_one_piece();
    wall_held();
    if (fluid_ >= 0 && !layers_.empty()) interface();
  }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& problem, const std::string& remedy) const {
    throw InputError(file_, key, problem, remedy);
  }

  /// Centre of the vertices of a facet.
  Point centroid(const Facet& f) const {
    Point sum = mesh_.nodes[f[0]];
    for (int i = 1; i < Dim; ++i) sum = sum + mesh_.nodes[f[i]];
    return (1.0 / Dim) * sum;
  }
  /// Between two vertices of a facet.
  double longest_edge(const Facet& f) const {
    double longest = 0;
    for (int i = 0; i < Dim; ++i)
      longest = std::max(longest, distance(mesh_.nodes[f[i]], mesh_.nodes[f[(i + 1) % Dim]]));
    return longest;
  }

  const std::string& region_of(int cell) const { return mesh_.regions[mesh_.cell_region[cell]]; }

  void volumes() {
    const auto find = [&](const std::string& name) {
      const int region = mesh_.region_index(name);
      if (region < 0 ||
          std::find(mesh_.cell_region.begin(), mesh_.cell_region.end(), region) == mesh_.cell_region.end())
        fail(name, fmt::format("the {} is missing or empty", Words::region_group),
             fmt::format("give it {}, or take it out of the case", Words::cells));
      return region;
    };
    if (needs_.fluid) fluid_ = find(group::fluid);
    for (const auto& layer : needs_.layers) layers_.push_back(find(layer));
  }

  void curved_cells() const {
    if constexpr (Order == 2)
      for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
        std::array<Point, nodes_of_simplex(Dim, 2)> x;
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = mesh_.nodes[mesh_.cells[c][i]];
        if (const auto jacobian = cell_jacobian<Dim>(x); !jacobian.positive)
          fail(fmt::format("{} {} of {}", Words::cell, c + 1, region_of(static_cast<int>(c))),
               bad_curved_cell(jacobian), curved_cell_remedy);
      }
  }

  /// Nodes in the same place are a crack in the mesh. Sorted into boxes of a grid much wider than the tolerance; a node
  /// near a box's side is looked for in the next one, too.
  void same_place() const {
    Point low = mesh_.nodes.front(), high = low;
    for (const Point& x : mesh_.nodes)
      for (int d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], x[d]);
        high[d] = std::max(high[d], x[d]);
      }
    const double size = distance(low, high), tolerance = 1e-9 * size, box = 1e-6 * size;
    const auto number = [&](int d, double value) {
      return static_cast<std::int64_t>(std::floor((value - low[d]) / box));
    };
    const auto hash = [](std::int64_t i, std::int64_t j, std::int64_t k) {
      return (static_cast<std::uint64_t>(i) << 42) ^ (static_cast<std::uint64_t>(j) << 21) ^
             static_cast<std::uint64_t>(k);
    };
    std::unordered_map<std::uint64_t, std::vector<int>> boxes;
    boxes.reserve(2 * mesh_.nodes.size());
    for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) {
      const Point& x = mesh_.nodes[n];
      for (auto i = number(0, x[0] - tolerance); i <= number(0, x[0] + tolerance); ++i)
        for (auto j = number(1, x[1] - tolerance); j <= number(1, x[1] + tolerance); ++j)
          for (auto k = number(2, x[2] - tolerance); k <= number(2, x[2] + tolerance); ++k) {
            const auto found = boxes.find(hash(i, j, k));
            if (found == boxes.end()) continue;
            for (const int other : found->second)
              if (distance(mesh_.nodes[other], x) <= tolerance)
                fail(fmt::format("nodes at {}", text(x)), coincidence(other, static_cast<int>(n)), conforming_remedy);
          }
      boxes[hash(number(0, x[0]), number(1, x[1]), number(2, x[2]))].push_back(static_cast<int>(n));
    }
  }

  std::string coincidence(int a, int b) const {
    std::string first, second;
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      for (const int node : mesh_.cells[c]) {
        if (node == a) first = region_of(static_cast<int>(c));
        if (node == b) second = region_of(static_cast<int>(c));
      }
    return fmt::format("two nodes in the same place, one of {} and one of {}: the mesh is not conforming", first,
                       second);
  }

  void facets_of_cells() {
    const auto uses = sorted_facet_uses(mesh_);
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
      for (end = begin; end < uses.size() && uses[end].key == uses[begin].key;) ++end;
      const auto& first = uses[begin];
      const auto facet = outward_facets<Dim, Order>(mesh_.cells[first.cell])[first.local];
      const auto where = [&] { return fmt::format("facet at {}", text(centroid(facet))); };
      if (end - begin > 2)
        fail(where(), fmt::format("{} {} share it", end - begin, Words::cells),
             "a facet has one or two; remove overlapping volumes and mesh again");
      if (end - begin == 2) {
        const auto& second = uses[begin + 1];
        const auto other = outward_facets<Dim, Order>(mesh_.cells[second.cell])[second.local];
        // Seen from the other side a facet runs the other way round.
        for (int i = 0; i < Dim; ++i)
          if (other[i] == facet[0] && (Dim == 2 ? i == 0 : other[(i + 1) % Dim] == facet[1]))
            fail(where(),
                 fmt::format("its two {} (in {} and {}) lie on the same side: the mesh is folded", Words::cells,
                             region_of(first.cell), region_of(second.cell)),
                 "mesh again, with smaller elements where layers are thin");
        pairs_.emplace_back(first.cell, second.cell);
      }
      auto& entry = cells_of_[first.key];
      entry = {first.cell, end - begin == 2 ? uses[begin + 1].cell : -1};
    }
  }

  /// A surface group that the scene needs, or that is there: each facet must bound a cell of `regions`, with nothing
  /// behind it.
  void surface(const std::string& name, const std::vector<int>& regions, const std::string& owner,
               bool required) const {
    const auto* facets = mesh_.facets(name);
    if (facets == nullptr || facets->empty()) {
      if (required)
        fail(name, fmt::format("the {} is missing or empty", Words::facet_group),
             other_name_for(name, regions) + fmt::format("name the {} of {} in gmsh, e.g. {}(\"{}\") = {{1}};",
                                                         Dim == 3 ? "faces" : "sides", owner, Words::facet_command,
                                                         name));
      return;
    }
    const auto is_in = [&](int cell) {
      return cell >= 0 && std::find(regions.begin(), regions.end(), mesh_.cell_region[cell]) != regions.end();
    };
    std::size_t foreign = 0, within = 0;
    const Facet* first = nullptr;
    for (const auto& facet : *facets) {
      const auto found = cells_of_.find(facet_key<Dim>(facet));
      if (found == cells_of_.end())
        fail(name, fmt::format("the {} at {} is no facet of a {}", Words::facet, text(centroid(facet)), Words::cell),
             Dim == 3 ? "save surfaces and volumes of one conforming mesh"
                      : "save curves and surfaces of one conforming mesh");
      const auto [a, b] = found->second;
      const bool bad_owner = !is_in(a) && !is_in(b), bad_side = !bad_owner && b >= 0;
      foreign += bad_owner;
      within += bad_side;
      if ((bad_owner || bad_side) && first == nullptr) first = &facet;
    }
    if (foreign > 0)
      fail(name,
           fmt::format("{} of {} {} do not bound {}, the first at {}", foreign, facets->size(), Words::facets, owner,
                       text(centroid(*first))),
           fmt::format("put {} of {} only into this group", Dim == 3 ? "faces" : "sides", owner));
    if (within > 0)
      fail(name,
           fmt::format("{} of {} {} lie between two {}, the first at {}", within, facets->size(), Words::facets,
                       Words::cells, text(centroid(*first))),
           fmt::format("put {} on the outside of the mesh only into this group", Dim == 3 ? "faces" : "sides"));
  }

  /// Surfaces on the outside of these volumes that the scene has no use for: one of them may be what is missed.
  std::vector<std::string> unused_surfaces(const std::vector<int>& regions) const {
    std::vector<std::string> used{group::inlet, group::outlet, group::wall_ends, group::outer, group::inner};
    used.insert(used.end(), needs_.openings.begin(), needs_.openings.end());
    used.insert(used.end(), needs_.supports.begin(), needs_.supports.end());
    std::vector<std::string> found;
    for (const auto& group : mesh_.facet_groups) {
      if (group::is_symmetry_plane(group.name) || std::find(used.begin(), used.end(), group.name) != used.end())
        continue;
      const bool outside = std::all_of(group.facets.begin(), group.facets.end(), [&](const Facet& facet) {
        const auto cells = cells_of_.find(facet_key<Dim>(facet));
        return cells != cells_of_.end() && cells->second.second < 0 &&
               std::find(regions.begin(), regions.end(), mesh_.cell_region[cells->second.first]) != regions.end();
      });
      if (outside && !group.facets.empty()) found.push_back(group.name);
    }
    return found;
  }

  /// What a surface of another name would have to be told, for remedies; empty when the mesh has none, else with ", or ".
  std::string other_name_for(const std::string& missed, const std::vector<int>& regions) const {
    const auto names = unused_surfaces(regions);
    if (names.empty()) return "";
    const std::string name = nearest_name(missed, names);
    if (missed == group::wall_ends)
      return fmt::format("if {} is meant, rename it, or add [[support]] with surface = \"{}\" and fixed = {}, or ",
                         one_of(names), name, all_components());
    if (missed == group::inlet || missed == group::outlet)
      return fmt::format("if {} is meant, rename it, or add [[opening]] with surface = \"{}\", or ", one_of(names),
                         name);
    return fmt::format("if {} is meant, give that name, or ", one_of(names));
  }

  /// What `fixed` of a support says of a surface that cannot move.
  const char* all_components() const {
    if (Dim == 3) return R"(["x", "y", "z"])";
    return axisymmetric() ? R"(["r", "z"])" : R"(["x", "y"])";
  }

  /// Of a wall that ends where it should go on.
  std::string left_out_volumes() const {
    if (needs_.left_out.empty()) return "";
    return fmt::format("give {} of the mesh, which the case leaves out, a section [structure.layers.{}], or ",
                       fmt::join(needs_.left_out, ", "), needs_.left_out.front());
  }

  void surfaces() const {
    const std::string wall = "the wall";
    if (needs_.inlet || needs_.outlet) {
      surface(group::inlet, {fluid_}, "the fluid", needs_.inlet);
      surface(group::outlet, {fluid_}, "the fluid", needs_.outlet);
      disjoint(group::inlet, group::outlet);
    }
    for (std::size_t i = 0; i < needs_.openings.size(); ++i) {
      surface(needs_.openings[i], {fluid_}, "the fluid", true);
      for (std::size_t j = 0; j < i; ++j) disjoint(needs_.openings[j].c_str(), needs_.openings[i].c_str());
    }
    if (!layers_.empty()) {
      surface(group::wall_ends, layers_, wall, held_by_wall_ends_alone() && !supported_by_symmetry());
      surface(group::outer, layers_, wall, false);
      if (needs_.inner_surface) surface(group::inner, layers_, wall, true);
      for (const auto& name : needs_.supports) surface(name, layers_, wall, true);
    }
    symmetry();
    straight_axis();
  }

  /// No facet in both of two groups.
  void disjoint(const char* first, const char* second) const {
    const auto *some = mesh_.facets(first), *others = mesh_.facets(second);
    if (some == nullptr || others == nullptr) return;
    FacetSet keys;
    for (const auto& facet : *some) keys.insert(facet_key<Dim>(facet));
    for (const auto& facet : *others)
      if (keys.count(facet_key<Dim>(facet)))
        fail(second, fmt::format("the {} at {} is in {}, too", Words::facet, text(centroid(facet)), first),
             fmt::format("put every {} into one of the two groups only", Dim == 3 ? "face" : "side"));
  }

  bool held_by_wall_ends_alone() const {
    return needs_.holding.size() == 1 && needs_.holding.front() == group::wall_ends;
  }
  /// What can hold a wall whose ends are clamped nowhere: an axis or planes of symmetry.
  bool supported_by_symmetry() const {
    if (Dim == 2 && needs_.geometry == TriangleGeometry::axisymmetric) return true;
    return !planes_.empty();
  }

  void symmetry() const {
    std::vector<int> all(mesh_.regions.size());
    std::iota(all.begin(), all.end(), 0);
    for (const auto& plane : planes_) {
      const std::string& name = plane.group->name;
      const auto axis = std::find(group::symmetry.begin(), group::symmetry.end(), name) - group::symmetry.begin();
      if (Dim == 2 && axis == (axisymmetric() ? 1 : 2))
        fail(name, "the mesh lies in this plane itself",
             axisymmetric() ? "planes normal to the axis are symmetry_z; r is along x, the axis along z"
                            : "sides of a plane mesh are symmetry_x or symmetry_y");
      surface(name, all, "fluid or wall", false);
      if (axis < 3)
        normal_to(static_cast<int>(axis), plane);
      else
        flat(plane);
      disjoint(group::inlet, name.c_str());
      disjoint(group::outlet, name.c_str());
      for (const auto& opening : needs_.openings) disjoint(opening.c_str(), name.c_str());
    }
  }

  /// Facets that may lie in several planes normal to one axis.
  void normal_to(int axis, const Plane& plane) const {
    for (const auto& facet : plane.group->facets) {
      double low = mesh_.nodes[facet[0]][axis], high = low;
      for (const int node : facet) {
        low = std::min(low, mesh_.nodes[node][axis]);
        high = std::max(high, mesh_.nodes[node][axis]);
      }
      if (high - low > flatness())
        fail(plane.group->name,
             fmt::format("the {} at {} does not lie in a plane normal to {}: its nodes are {:.3g} mm apart along it",
                         Words::facet, text(centroid(facet)), "xyz"[axis], high - low),
             "put flat faces normal to this axis only into this group, and other planes into symmetry_1, symmetry_2 "
             "and so on");
    }
  }

  /// Facets that define a plane themselves.
  void flat(const Plane& plane) const {
    const auto& [group, normal] = plane;
    if (Dim == 2 && axisymmetric() && normal[0] != 0)
      fail(group->name, "its sides are not normal to the axis: turned about it they are no plane",
           "put sides of one height only into this group");
    double mean = 0, count = 0;
    for (const auto& facet : group->facets)
      for (const int node : facet) {
        mean += dot(normal, mesh_.nodes[node]);
        ++count;
      }
    mean /= count;
    double furthest = 0;
    const Facet* worst = nullptr;
    for (const auto& facet : group->facets)
      for (const int node : facet)
        if (const double off = std::abs(dot(normal, mesh_.nodes[node]) - mean); off > furthest) {
          furthest = off;
          worst = &facet;
        }
    if (furthest > flatness())
      fail(group->name,
           fmt::format("its {} do not lie in one plane: the one at {} is {:.3g} mm off their mean plane", Words::facets,
                       text(centroid(*worst)), furthest),
           "put each plane into a group of its own: symmetry_1, symmetry_2 and so on");
  }

  /// How far off its plane a node may lie, mm.
  double flatness() const { return 1e-6 * size(); }
  bool axisymmetric() const { return needs_.geometry == TriangleGeometry::axisymmetric; }

  /// A side of quadratic triangles that runs from axis to axis beside it would be a wall.
  void straight_axis() const {
    if constexpr (Dim == 2 && Order == 2) {
      if (needs_.geometry != TriangleGeometry::axisymmetric) return;
      for (const auto& cell : mesh_.cells)
        for (const auto& facet : outward_facets<Dim, Order>(cell))
          if (mesh_.nodes[facet[0]][0] == 0 && mesh_.nodes[facet[1]][0] == 0 && mesh_.nodes[facet[2]][0] != 0)
            fail(fmt::format("node at {}", text(mesh_.nodes[facet[2]])), "is off the axis between two nodes on it",
                 "give the axis straight sides with r = 0");
    }
  }

  /// Diagonal of the box around the mesh, mm.
  double size() const {
    Point low = mesh_.nodes.front(), high = low;
    for (const Point& x : mesh_.nodes)
      for (int d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], x[d]);
        high[d] = std::max(high[d], x[d]);
      }
    return distance(low, high);
  }

  /// Cells connected by shared facets, as far as `joins` allows; per cell the root of its set.
  template <class Joins>
  std::vector<int> pieces(const Joins& joins) const {
    DisjointSets sets(mesh_.cells.size());
    for (const auto& [a, b] : pairs_)
      if (joins(a) && joins(b)) sets.join(a, b);
    std::vector<int> roots(mesh_.cells.size());
    for (std::size_t c = 0; c < roots.size(); ++c) roots[c] = sets.root(static_cast<int>(c));
    return roots;
  }

  void fluid_in_one_piece() const {
    if (fluid_ < 0) return;
    const auto roots = pieces([&](int cell) { return mesh_.cell_region[cell] == fluid_; });
    std::unordered_map<int, std::size_t> sizes;
    for (std::size_t c = 0; c < roots.size(); ++c)
      if (mesh_.cell_region[c] == fluid_) ++sizes[roots[c]];
    if (sizes.size() < 2) return;
    std::vector<std::size_t> sorted;
    for (const auto& [root, size] : sizes) sorted.push_back(size);
    std::sort(sorted.rbegin(), sorted.rend());
    fail(group::fluid,
         fmt::format("the volume is in {} pieces that share no facet, the largest of {} and {} {}", sorted.size(),
                     sorted[0], sorted[1], Words::cells),
         "connect them, or leave the smaller ones out of the group");
  }

  bool is_wall(int cell) const {
    return std::find(layers_.begin(), layers_.end(), mesh_.cell_region[cell]) != layers_.end();
  }

  /// Calls visit(facets) for the facets of the named groups and of the planes of symmetry.
  template <class Visit>
  void for_groups_and_planes(const std::vector<std::string>& names, Visit visit) const {
    for (const auto& name : names)
      if (const auto* facets = mesh_.facets(name)) visit(*facets);
    for (const auto& plane : planes_) visit(plane.group->facets);
  }

  /// A piece of the wall that nothing holds can drift away.
  void wall_held() const {
    if (layers_.empty() || (Dim == 2 && needs_.geometry == TriangleGeometry::axisymmetric)) return;
    const auto roots = pieces([&](int cell) { return is_wall(cell); });
    std::vector<char> held(mesh_.cells.size(), 0);
    for_groups_and_planes(needs_.holding, [&](const auto& facets) {
      for (const auto& facet : facets) {
        const auto [a, b] = cells_of_.at(facet_key<Dim>(facet));
        for (const int cell : {a, b})
          if (cell >= 0) held[roots[cell]] = 1;
      }
    });
    for (std::size_t c = 0; c < roots.size(); ++c)
      if (is_wall(static_cast<int>(c)) && !held[roots[c]])
        fail(group::wall_ends,
             fmt::format("a piece of {} with {} {} has no face {}", region_of(static_cast<int>(c)),
                         std::count(roots.begin(), roots.end(), roots[c]), Words::cells,
                         held_by_wall_ends_alone() ? "in this group" : "that is held"),
             left_out_volumes() + "connect it to the rest of the wall by shared facets, or clamp it");
  }

  void interface() const {
    const auto shared = interface_facets(mesh_, fluid_, layers_);
    if (shared.empty()) fail("interface", "the wall does not touch the fluid: they share no facet", conforming_remedy);
    faces_that_meet_unshared();

    std::vector<Facet> held;
    for_groups_and_planes(needs_.clamping,
                          [&](const auto& facets) { held.insert(held.end(), facets.begin(), facets.end()); });
    const auto clamped = facet_nodes(held), free = free_rims(shared);
    // An interface that ends on the axis is closed there.
    const auto on_axis = [&](int node) {
      return Dim == 2 && needs_.geometry == TriangleGeometry::axisymmetric && mesh_.nodes[node][0] == 0;
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
      fail(
          group::wall_ends,
          fmt::format("the rim of the interface is not clamped: {} of its nodes are not in this group, the first at {}",
                      loose, text(mesh_.nodes[first])),
          left_out_volumes() + other_name_for(group::wall_ends, layers_) +
              std::string(std::find(needs_.clamping.begin(), needs_.clamping.end(), group::wall_ends) !=
                                  needs_.clamping.end()
                              ? ""
                              : "fix all components of its support (only ends that a support names and that meet the "
                                "fluid in an "
                                "opening can slide or be free), or ") +
              "put both end faces of all wall layers into it, or planes of symmetry into symmetry_x, symmetry_y, "
              "symmetry_z, or symmetry_1 and so on");
  }

  /// Nodes where the wall may move although the interface ends there: in surfaces that supports name, where an opening
  /// begins that can follow them, and no face that the fluid sticks to.
  std::vector<int> free_rims(const std::vector<Facet>& shared) const {
    if (needs_.supports.empty()) return {};
    std::vector<std::string> open = needs_.openings;
    if (needs_.inlet) open.emplace_back(group::inlet);
    if (needs_.outlet) open.emplace_back(group::outlet);
    const auto nodes_of = [&](const std::vector<std::string>& names) {
      std::vector<Facet> facets;
      for (const auto& name : names)
        if (const auto* group = mesh_.facets(name)) facets.insert(facets.end(), group->begin(), group->end());
      return facet_nodes(facets);
    };
    FacetSet passable;
    for (const auto& facet : shared) passable.insert(facet_key<Dim>(facet));
    for_groups_and_planes(open, [&](const auto& facets) {
      for (const auto& facet : facets) passable.insert(facet_key<Dim>(facet));
    });
    std::vector<Facet> sticking;
    for (const auto& facet : boundary_facets(mesh_, {fluid_})) {
      const auto on_axis = [&](int node) { return axisymmetric() && mesh_.nodes[node][0] == 0; };
      if (passable.count(facet_key<Dim>(facet.nodes)) || std::all_of(facet.nodes.begin(), facet.nodes.end(), on_axis))
        continue;
      sticking.push_back(facet.nodes);
    }
    const auto named = nodes_of(needs_.supports), at_openings = nodes_of(open), stuck = facet_nodes(sticking);
    std::vector<int> in_both, free;
    std::set_intersection(named.begin(), named.end(), at_openings.begin(), at_openings.end(),
                          std::back_inserter(in_both));
    std::set_difference(in_both.begin(), in_both.end(), stuck.begin(), stuck.end(), std::back_inserter(free));
    return free;
  }

  /// Free faces of fluid and wall that lie on each other: they look like an interface and would act as two walls.
  void faces_that_meet_unshared() const {
    const auto free_faces = [&](const std::vector<int>& regions, const std::vector<const char*>& named) {
      FacetSet skip;
      for (const char* name : named)
        for_groups_and_planes({name}, [&](const auto& facets) {
          for (const auto& facet : facets) skip.insert(facet_key<Dim>(facet));
        });
      std::vector<Facet> faces;
      for (const auto& facet : boundary_facets(mesh_, regions))
        if (const auto key = facet_key<Dim>(facet.nodes); cells_of_.at(key).second < 0 && !skip.count(key))
          faces.push_back(facet.nodes);
      return faces;
    };
    const auto fluid = free_faces({fluid_}, {group::inlet, group::outlet});
    if (fluid.empty()) return;
    const auto wall = free_faces(layers_, {group::wall_ends, group::outer});

    // Sorted along x, so that a facet is compared with those near it only.
    struct Placed {
      double x;
      Point centre;
      double size;
      Facet facet;
    };
    const auto placed = [&](const Facet& f) {
      const Point centre = centroid(f);
      return Placed{centre[0], centre, longest_edge(f), f};
    };
    std::vector<Placed> walls;
    double largest = 0;
    for (const auto& f : wall) {
      walls.push_back(placed(f));
      largest = std::max(largest, walls.back().size);
    }
    std::sort(walls.begin(), walls.end(), [](const Placed& a, const Placed& b) { return a.x < b.x; });
    // Of edges the vector along them: it turns with the normal, which is all that is asked of it.
    const auto area = [&](const Facet& f) {
      if constexpr (Dim == 3)
        return triangle_area_vector(mesh_.nodes[f[0]], mesh_.nodes[f[1]], mesh_.nodes[f[2]]);
      else
        return mesh_.nodes[f[1]] - mesh_.nodes[f[0]];
    };
    const auto distance_to = [&](const Point& x, const Facet& f) {
      if constexpr (Dim == 3)
        return distance_to_triangle(x, mesh_.nodes[f[0]], mesh_.nodes[f[1]], mesh_.nodes[f[2]]);
      else
        return distance_to_segment(x, mesh_.nodes[f[0]], mesh_.nodes[f[1]]);
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
        fail("interface",
             fmt::format("at {} {} of fluid and {} lie on each other without sharing nodes (hanging nodes)",
                         text(here.centre), Dim == 3 ? "faces" : "sides",
                         region_of(cells_of_.at(facet_key<Dim>(it->facet)).first)),
             conforming_remedy);
      }
    }
  }

  const Mesh& mesh_;
  const SceneMeshNeeds& needs_;
  const std::string& file_;
  std::vector<Plane> planes_;
  int fluid_ = -1;
  std::vector<int> layers_;
  std::vector<std::pair<int, int>> pairs_;                               ///< cells that share a facet
  std::unordered_map<Key, std::pair<int, int>, FacetKeyHash> cells_of_;  ///< second is -1 on the boundary
};

}  // namespace

template <int Dim, int Order>
void check_scene_mesh(const SimplexMesh<Dim, Order>& mesh, const SceneMeshNeeds& needs, const std::string& file) {
  Checks<Dim, Order>(mesh, needs, file).run();
}

#define INSTANTIATE(Dim, Order) \
  template void check_scene_mesh(const SimplexMesh<Dim, Order>&, const SceneMeshNeeds&, const std::string&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
