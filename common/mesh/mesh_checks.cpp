#include "mesh/mesh_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "mesh/checked_mesh.hpp"
#include "mesh/curved_cells.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/facet_uses.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/interface_checks.hpp"
#include "mesh/surface_checks.hpp"

namespace fsi {

namespace {

template <int Dim, int Order>
class Checks {
  using Mesh = SimplexMesh<Dim, Order>;
  using Words = CellWords<Dim>;

 public:
  Checks(const Mesh& mesh, const SceneMeshNeeds& needs, const std::string& file) : checked_{mesh, needs, file} {}

  void run() {
    volumes();
    same_place();
    curved_cells();
    facets_of_cells();
    check_surfaces(checked_);
    fluid_in_one_piece();
    wall_held();
    check_contact();
  }

  /// What each of these steps refuses. Without sound facets the steps behind them mean nothing.
  std::vector<MeshFault> faults() {
    using Kind = MeshFault::Kind;
    std::vector<MeshFault> found;
    const auto passes = [&](Kind kind, const auto& step) {
      try {
        step();
        return true;
      } catch (const InputError& error) {
        found.push_back({kind, error.what()});
        return false;
      }
    };
    if (!passes(Kind::volumes, [&] { volumes(); })) return found;
    passes(Kind::doubled_nodes, [&] { same_place(); });
    passes(Kind::folded_curved_cells, [&] { curved_cells(); });
    if (!passes(Kind::folded_facets, [&] { facets_of_cells(); })) return found;
    passes(Kind::surfaces, [&] { check_surfaces(checked_); });
    passes(Kind::fluid_in_pieces, [&] { fluid_in_one_piece(); });
    passes(Kind::loose_wall, [&] { wall_held(); });
    passes(Kind::interface, [&] { check_contact(); });
    return found;
  }

 private:
  void check_contact() const {
    if (checked_.fluid >= 0 && !checked_.layers.empty()) check_interface(checked_);
  }

  void volumes() {
    const auto find = [&](const std::string& name) {
      const int region = checked_.mesh.region_index(name);
      if (region < 0 || std::find(checked_.mesh.cell_region.begin(), checked_.mesh.cell_region.end(), region) ==
                            checked_.mesh.cell_region.end())
        checked_.fail(name, fmt::format("the {} is missing or empty", Words::region_group),
                      fmt::format("give it {}, or take it out of the case", Words::cells));
      return region;
    };
    if (checked_.needs.fluid) checked_.fluid = find(group::fluid);
    for (const auto& layer : checked_.needs.layers) checked_.layers.push_back(find(layer));
  }

  void curved_cells() const {
    if constexpr (Order == 2)
      for (std::size_t c = 0; c < checked_.mesh.cells.size(); ++c) {
        std::array<Point, nodes_of_simplex(Dim, 2)> x;
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = checked_.mesh.nodes[checked_.mesh.cells[c][i]];
        if (is_surely_positive<Dim>(x)) continue;  // true of most, in a tenth of the time
        if (const auto jacobian = cell_jacobian<Dim>(x); !jacobian.positive)
          checked_.fail(fmt::format("{} {} of {}", Words::cell, c + 1, checked_.region_of(static_cast<int>(c))),
                        bad_curved_cell(jacobian), curved_cell_remedy);
      }
  }

  /// Nodes in the same place are a crack in the mesh. Sorted into boxes of a grid much wider than the tolerance; a node
  /// near a box's side is looked for in the next one, too.
  void same_place() const {
    const BoundingBox around(checked_.mesh.nodes);
    const double size = around.size(), tolerance = 1e-9 * size, box = 1e-6 * size;
    const auto number = [&](int d, double value) {
      return static_cast<std::int64_t>(std::floor((value - around.low[d]) / box));
    };
    const auto hash = [](std::int64_t i, std::int64_t j, std::int64_t k) {
      return (static_cast<std::uint64_t>(i) << 42) ^ (static_cast<std::uint64_t>(j) << 21) ^
             static_cast<std::uint64_t>(k);
    };
    std::unordered_map<std::uint64_t, std::vector<int>> boxes;
    boxes.reserve(2 * checked_.mesh.nodes.size());
    for (std::size_t n = 0; n < checked_.mesh.nodes.size(); ++n) {
      const Point& x = checked_.mesh.nodes[n];
      for (auto i = number(0, x[0] - tolerance); i <= number(0, x[0] + tolerance); ++i)
        for (auto j = number(1, x[1] - tolerance); j <= number(1, x[1] + tolerance); ++j)
          for (auto k = number(2, x[2] - tolerance); k <= number(2, x[2] + tolerance); ++k) {
            const auto found = boxes.find(hash(i, j, k));
            if (found == boxes.end()) continue;
            for (const int other : found->second)
              if (distance(checked_.mesh.nodes[other], x) <= tolerance)
                checked_.fail(fmt::format("nodes at {}", checked_.text(x)), coincidence(other, static_cast<int>(n)),
                              conforming_remedy);
          }
      boxes[hash(number(0, x[0]), number(1, x[1]), number(2, x[2]))].push_back(static_cast<int>(n));
    }
  }

  std::string coincidence(int a, int b) const {
    std::string first, second;
    for (std::size_t c = 0; c < checked_.mesh.cells.size(); ++c)
      for (const int node : checked_.mesh.cells[c]) {
        if (node == a) first = checked_.region_of(static_cast<int>(c));
        if (node == b) second = checked_.region_of(static_cast<int>(c));
      }
    return fmt::format("two nodes in the same place, one of {} and one of {}: the mesh is not conforming", first,
                       second);
  }

  void facets_of_cells() {
    const auto uses = sorted_facet_uses(checked_.mesh);
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
      for (end = begin; end < uses.size() && uses[end].key == uses[begin].key;) ++end;
      const auto& first = uses[begin];
      const auto facet = outward_facets<Dim, Order>(checked_.mesh.cells[first.cell])[first.local];
      const auto where = [&] { return fmt::format("facet at {}", checked_.text(checked_.centroid(facet))); };
      if (end - begin > 2)
        checked_.fail(where(), fmt::format("{} {} share it", end - begin, Words::cells),
                      "a facet has one or two; remove overlapping volumes and mesh again");
      if (end - begin == 2) {
        const auto& second = uses[begin + 1];
        const auto other = outward_facets<Dim, Order>(checked_.mesh.cells[second.cell])[second.local];
        // Seen from the other side a facet runs the other way round.
        for (int i = 0; i < Dim; ++i)
          if (other[i] == facet[0] && (Dim == 2 ? i == 0 : other[(i + 1) % Dim] == facet[1]))
            checked_.fail(where(),
                          fmt::format("its two {} (in {} and {}) lie on the same side: the mesh is folded",
                                      Words::cells, checked_.region_of(first.cell), checked_.region_of(second.cell)),
                          "mesh again, with smaller elements where layers are thin");
        pairs_.emplace_back(first.cell, second.cell);
      }
      checked_.facet_cells.push_back({first.key, first.cell, end - begin == 2 ? uses[begin + 1].cell : -1});
    }
  }

  /// Cells connected by shared facets, as far as `joins` allows; per cell the root of its set.
  template <class Joins>
  std::vector<int> pieces(const Joins& joins) const {
    DisjointSets sets(checked_.mesh.cells.size());
    for (const auto& [a, b] : pairs_)
      if (joins(a) && joins(b)) sets.join(a, b);
    std::vector<int> roots(checked_.mesh.cells.size());
    for (std::size_t c = 0; c < roots.size(); ++c) roots[c] = sets.root(static_cast<int>(c));
    return roots;
  }

  void fluid_in_one_piece() const {
    if (checked_.fluid < 0) return;
    const auto roots = pieces([&](int cell) { return checked_.mesh.cell_region[cell] == checked_.fluid; });
    std::unordered_map<int, std::size_t> sizes;
    for (std::size_t c = 0; c < roots.size(); ++c)
      if (checked_.mesh.cell_region[c] == checked_.fluid) ++sizes[roots[c]];
    if (sizes.size() < 2) return;
    std::vector<std::size_t> sorted;
    for (const auto& [root, size] : sizes) sorted.push_back(size);
    std::sort(sorted.rbegin(), sorted.rend());
    checked_.fail(group::fluid,
                  fmt::format("the volume is in {} pieces that share no facet, the largest of {} and {} {}",
                              sorted.size(), sorted[0], sorted[1], Words::cells),
                  "connect them, or leave the smaller ones out of the group");
  }

  /// A piece of the wall that nothing holds can drift away.
  void wall_held() const {
    if (checked_.layers.empty() || checked_.held_by_inertia()) return;
    const auto roots = pieces([&](int cell) { return checked_.is_wall(cell); });
    std::vector<char> held(checked_.mesh.cells.size(), 0);
    checked_.for_groups_and_planes(checked_.needs.holding, [&](const auto& facets) {
      for (const auto& facet : facets) {
        const auto* cells = checked_.cells_of(facet_key<Dim>(facet));
        if (!cells) continue;  // no cell has it, so it holds none
        for (const int cell : {cells->first, cells->second})
          if (cell >= 0) held[roots[cell]] = 1;
      }
    });
    for (std::size_t c = 0; c < roots.size(); ++c)
      if (checked_.is_wall(static_cast<int>(c)) && !held[roots[c]])
        checked_.fail(group::wall_ends,
                      fmt::format("a piece of {} with {} {} has no face {}", checked_.region_of(static_cast<int>(c)),
                                  std::count(roots.begin(), roots.end(), roots[c]), Words::cells,
                                  checked_.held_by_wall_ends_alone() ? "in this group" : "that is held"),
                      checked_.left_out_volumes() + "connect it to the rest of the wall by shared facets, or clamp it");
  }

  CheckedMesh<Dim, Order> checked_;
  std::vector<std::pair<int, int>> pairs_;  ///< cells that share a facet
};

}  // namespace

template <int Dim, int Order>
void check_scene_mesh(const SimplexMesh<Dim, Order>& mesh, const SceneMeshNeeds& needs, const std::string& file) {
  Checks<Dim, Order>(mesh, needs, file).run();
}

template <int Dim, int Order>
std::vector<MeshFault> scene_mesh_faults(const SimplexMesh<Dim, Order>& mesh, const SceneMeshNeeds& needs,
                                         const std::string& file) {
  return Checks<Dim, Order>(mesh, needs, file).faults();
}

#define INSTANTIATE(Dim, Order)                                                                              \
  template void check_scene_mesh(const SimplexMesh<Dim, Order>&, const SceneMeshNeeds&, const std::string&); \
  template std::vector<MeshFault> scene_mesh_faults(const SimplexMesh<Dim, Order>&, const SceneMeshNeeds&,   \
                                                    const std::string&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
