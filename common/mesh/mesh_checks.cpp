#include "mesh/mesh_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/facets.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

using Facet = TetrahedralMesh::Facet;
using FacetSet = std::unordered_set<std::array<int, 3>, FacetKeyHash>;

constexpr const char* conforming_remedy =
    "mesh fluid and wall together, with one shared surface (gmsh: BooleanFragments or Coherence before meshing)";

std::string text(const Point& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
}

Point centroid(const TetrahedralMesh& mesh, const Facet& f) {
  return (1.0 / 3) * (mesh.nodes[f[0]] + mesh.nodes[f[1]] + mesh.nodes[f[2]]);
}

double longest_edge(const TetrahedralMesh& mesh, const Facet& f) {
  double longest = 0;
  for (int i = 0; i < 3; ++i) longest = std::max(longest, distance(mesh.nodes[f[i]], mesh.nodes[f[(i + 1) % 3]]));
  return longest;
}

/// Distance from x to the triangle abc (C. Ericson, Real-Time Collision Detection, section 5.1.5).
double distance_to_triangle(const Point& x, const Point& a, const Point& b, const Point& c) {
  const auto to_segment = [&](const Point& p, const Point& q) {
    const Point along = q - p;
    const double t = std::clamp(dot(x - p, along) / dot(along, along), 0.0, 1.0);
    return distance(x, p + t * along);
  };
  const Point normal = cross(b - a, c - a);
  const bool above = dot(cross(b - a, x - a), normal) >= 0 && dot(cross(c - b, x - b), normal) >= 0 &&
                     dot(cross(a - c, x - c), normal) >= 0;
  if (above) return std::abs(dot(x - a, normal)) / norm(normal);
  return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

class Checks {
 public:
  Checks(const TetrahedralMesh& mesh, const SceneMeshNeeds& needs, const std::string& file)
      : mesh_(mesh), needs_(needs), file_(file) {}

  void run() {
    volumes();
    same_place();
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

  const std::string& region_of(int cell) const { return mesh_.regions[mesh_.cell_region[cell]]; }

  void volumes() {
    const auto find = [&](const std::string& name) {
      const int region = mesh_.region_index(name);
      if (region < 0 ||
          std::find(mesh_.cell_region.begin(), mesh_.cell_region.end(), region) == mesh_.cell_region.end())
        fail(name, "the physical volume is missing or empty", "give it tetrahedra, or take it out of the case");
      return region;
    };
    if (needs_.fluid) fluid_ = find(group::fluid);
    for (const auto& layer : needs_.layers) layers_.push_back(find(layer));
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
      const auto facet = outward_facets(mesh_.cells[first.cell])[first.local];
      const auto where = [&] { return fmt::format("facet at {}", text(centroid(mesh_, facet))); };
      if (end - begin > 2)
        fail(where(), fmt::format("{} tetrahedra share it", end - begin),
             "a facet has one or two; remove overlapping volumes and mesh again");
      if (end - begin == 2) {
        const auto& second = uses[begin + 1];
        const auto other = outward_facets(mesh_.cells[second.cell])[second.local];
        // Seen from the other side a facet runs the other way round.
        for (int i = 0; i < 3; ++i)
          if (other[i] == facet[0] && other[(i + 1) % 3] == facet[1])
            fail(where(),
                 fmt::format("its two tetrahedra (in {} and {}) lie on the same side: the mesh is folded",
                             region_of(first.cell), region_of(second.cell)),
                 "mesh again, with smaller elements where layers are thin");
        pairs_.emplace_back(first.cell, second.cell);
      }
      auto& entry = cells_of_[first.key];
      entry = {first.cell, end - begin == 2 ? uses[begin + 1].cell : -1};
    }
  }

  /// A surface group that the scene needs, or that is there: each triangle must bound a cell of `regions`, with nothing
  /// behind it.
  void surface(const std::string& name, const std::vector<int>& regions, const std::string& owner,
               bool required) const {
    const auto* facets = mesh_.facets(name);
    if (facets == nullptr || facets->empty()) {
      if (required)
        fail(name, "the physical surface is missing or empty",
             fmt::format("name the faces of {} in gmsh, e.g. Physical Surface(\"{}\") = {{1}};", owner, name));
      return;
    }
    const auto is_in = [&](int cell) {
      return cell >= 0 && std::find(regions.begin(), regions.end(), mesh_.cell_region[cell]) != regions.end();
    };
    std::size_t foreign = 0, within = 0;
    const Facet* first = nullptr;
    for (const auto& facet : *facets) {
      const auto found = cells_of_.find(facet_key(facet));
      if (found == cells_of_.end())
        fail(name, fmt::format("the triangle at {} is no facet of a tetrahedron", text(centroid(mesh_, facet))),
             "save surfaces and volumes of one conforming mesh");
      const auto [a, b] = found->second;
      const bool bad_owner = !is_in(a) && !is_in(b), bad_side = !bad_owner && b >= 0;
      foreign += bad_owner;
      within += bad_side;
      if ((bad_owner || bad_side) && first == nullptr) first = &facet;
    }
    if (foreign > 0)
      fail(name,
           fmt::format("{} of {} triangles do not bound {}, the first at {}", foreign, facets->size(), owner,
                       text(centroid(mesh_, *first))),
           fmt::format("put faces of {} only into this group", owner));
    if (within > 0)
      fail(name,
           fmt::format("{} of {} triangles lie between two tetrahedra, the first at {}", within, facets->size(),
                       text(centroid(mesh_, *first))),
           "put faces on the outside of the mesh only into this group");
  }

  void surfaces() const {
    const std::string wall = "the wall";
    if (needs_.inlet_outlet) {
      surface(group::inlet, {fluid_}, "the fluid", true);
      surface(group::outlet, {fluid_}, "the fluid", true);
      FacetSet inlet;
      for (const auto& facet : *mesh_.facets(group::inlet)) inlet.insert(facet_key(facet));
      for (const auto& facet : *mesh_.facets(group::outlet))
        if (inlet.count(facet_key(facet)))
          fail(group::outlet, fmt::format("the triangle at {} is in inlet, too", text(centroid(mesh_, facet))),
               "put every face into one of the two groups only");
    }
    if (!layers_.empty()) {
      surface(group::wall_ends, layers_, wall, true);
      surface(group::outer, layers_, wall, false);
      if (needs_.inner_surface) surface(group::inner, layers_, wall, true);
    }
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
         fmt::format("the volume is in {} pieces that share no facet, the largest of {} and {} tetrahedra",
                     sorted.size(), sorted[0], sorted[1]),
         "connect them, or leave the smaller ones out of the group");
  }

  bool is_wall(int cell) const {
    return std::find(layers_.begin(), layers_.end(), mesh_.cell_region[cell]) != layers_.end();
  }

  /// A piece of the wall that is clamped nowhere can drift away.
  void wall_held() const {
    if (layers_.empty()) return;
    const auto roots = pieces([&](int cell) { return is_wall(cell); });
    std::vector<char> held(mesh_.cells.size(), 0);
    for (const auto& facet : *mesh_.facets(group::wall_ends)) {
      const auto [a, b] = cells_of_.at(facet_key(facet));
      for (const int cell : {a, b})
        if (cell >= 0) held[roots[cell]] = 1;
    }
    for (std::size_t c = 0; c < roots.size(); ++c)
      if (is_wall(static_cast<int>(c)) && !held[roots[c]])
        fail(group::wall_ends,
             fmt::format("a piece of {} with {} tetrahedra has no face in this group", region_of(static_cast<int>(c)),
                         std::count(roots.begin(), roots.end(), roots[c])),
             "connect it to the rest of the wall by shared facets, or clamp it");
  }

  void interface() const {
    const auto shared = interface_facets(mesh_, fluid_, layers_);
    if (shared.empty()) fail("interface", "fluid and wall share no facet", conforming_remedy);
    faces_that_meet_unshared();

    const auto clamped = facet_nodes(*mesh_.facets(group::wall_ends));
    std::size_t loose = 0;
    int first = -1;
    for (const int node : rim_nodes(shared)) {
      if (std::binary_search(clamped.begin(), clamped.end(), node)) continue;
      ++loose;
      if (first < 0) first = node;
    }
    if (loose > 0)
      fail(
          group::wall_ends,
          fmt::format("the rim of the interface is not clamped: {} of its nodes are not in this group, the first at {}",
                      loose, text(mesh_.nodes[first])),
          "put both end faces of all wall layers into it");
  }

  /// Free faces of fluid and wall that lie on each other: they look like an interface and would act as two walls.
  void faces_that_meet_unshared() const {
    const auto free_faces = [&](const std::vector<int>& regions, const std::vector<const char*>& named) {
      FacetSet skip;
      for (const char* name : named)
        if (const auto* facets = mesh_.facets(name))
          for (const auto& facet : *facets) skip.insert(facet_key(facet));
      std::vector<Facet> faces;
      for (const auto& facet : boundary_facets(mesh_, regions))
        if (const auto key = facet_key(facet.nodes); cells_of_.at(key).second < 0 && !skip.count(key))
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
      const Point centre = centroid(mesh_, f);
      return Placed{centre[0], centre, longest_edge(mesh_, f), f};
    };
    std::vector<Placed> walls;
    double largest = 0;
    for (const auto& f : wall) {
      walls.push_back(placed(f));
      largest = std::max(largest, walls.back().size);
    }
    std::sort(walls.begin(), walls.end(), [](const Placed& a, const Placed& b) { return a.x < b.x; });
    const auto area = [&](const Facet& f) {
      return triangle_area_vector(mesh_.nodes[f[0]], mesh_.nodes[f[1]], mesh_.nodes[f[2]]);
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
        const auto& [a, b, c] = it->facet;
        const double gap = distance_to_triangle(here.centre, mesh_.nodes[a], mesh_.nodes[b], mesh_.nodes[c]);
        if (gap > 0.1 * std::min(here.size, it->size)) continue;  // two facetings of one curved face are this close
        fail("interface",
             fmt::format("at {} faces of fluid and {} lie on each other without sharing nodes (hanging nodes)",
                         text(here.centre), region_of(cells_of_.at(facet_key(it->facet)).first)),
             conforming_remedy);
      }
    }
  }

  const TetrahedralMesh& mesh_;
  const SceneMeshNeeds& needs_;
  const std::string& file_;
  int fluid_ = -1;
  std::vector<int> layers_;
  std::vector<std::pair<int, int>> pairs_;  ///< cells that share a facet
  std::unordered_map<std::array<int, 3>, std::pair<int, int>, FacetKeyHash>
      cells_of_;  ///< second is -1 on the boundary
};

}  // namespace

void check_scene_mesh(const TetrahedralMesh& mesh, const SceneMeshNeeds& needs, const std::string& file) {
  Checks(mesh, needs, file).run();
}

}  // namespace fsi
