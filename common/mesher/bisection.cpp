#include "mesher/bisection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "host/available_memory.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesher/child_cells.hpp"

namespace fsi {

namespace {

/// An edge, ordered by length; of equal ones by the numbers of its ends, so that cells agree.
struct OrderedEdge {
  double square;  ///< mm^2
  std::uint64_t key;
  int a, b;
  bool operator<(const OrderedEdge& other) const { return std::tie(square, key) < std::tie(other.square, other.key); }
  bool operator==(const OrderedEdge& other) const { return key == other.key; }
};

template <int Dim, int Order>
class Bisection {
  using Mesh = SimplexMesh<Dim, Order>;
  using Cell = typename Mesh::Cell;
  using Facet = typename Mesh::Facet;

 public:
  Bisection(const Mesh& mesh, const BisectionPlan& plan, std::string file)
      : file_(std::move(file)), plan_(plan), mesh_(mesh), weights_(plan.weights), is_halved_(mesh.cells.size(), 0) {
    assert(plan.weights.size() == mesh.cells.size());
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) list(static_cast<int>(c));
    for (std::size_t g = 0; g < mesh_.facet_groups.size(); ++g)
      for (std::size_t f = 0; f < mesh_.facet_groups[g].facets.size(); ++f) list_facet(g, f);
    if constexpr (Order == 2)
      for (const auto& cell : mesh_.cells)
        for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
          const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
          middles_.find_or_add(cell[a], cell[b], cell[Dim + 1 + e]);
        }
  }

  Mesh halve_heaviest() {
    while (!heaviest_.empty() && mesh_.nodes.size() < plan_.most_nodes) {
      const auto [weight, minus_cell] = heaviest_.top();
      const int cell = -minus_cell;
      if (weight <= 0) break;
      if (is_halved_[cell] != 0)
        heaviest_.pop();
      else
        halve_around(terminal_edge(cell));
    }
    return compact();
  }

 private:
  /// Enters a cell where cells are looked for.
  void list(int c) {
    for (const auto& [a, b] : SimplexEdges<Dim>::vertices)
      cells_at_[EdgeMiddles::key(mesh_.cells[c][a], mesh_.cells[c][b])].push_back(c);
    heaviest_.push({weights_[c], -c});  // of equal ones the first
  }
  void list_facet(std::size_t group, std::size_t f) {
    const auto& facet = mesh_.facet_groups[group].facets[f];
    for (const auto& [a, b] : SimplexEdges<Dim - 1>::vertices)
      facets_at_[EdgeMiddles::key(facet[a], facet[b])].push_back({group, f});
  }

  OrderedEdge edge(int a, int b) const {
    const Point apart = mesh_.nodes[std::max(a, b)] - mesh_.nodes[std::min(a, b)];
    return {dot(apart, apart), EdgeMiddles::key(a, b), a, b};
  }
  OrderedEdge longest_edge(int c) const {
    const Cell& cell = mesh_.cells[c];
    OrderedEdge longest{-1, 0, 0, 0};
    for (const auto& [a, b] : SimplexEdges<Dim>::vertices) longest = std::max(longest, edge(cell[a], cell[b]));
    return longest;
  }
  /// From a cell along longest edges to one that is the longest of all cells around it.
  OrderedEdge terminal_edge(int cell) const {
    OrderedEdge found = longest_edge(cell);
    for (bool goes_on = true; goes_on;) {
      goes_on = false;
      for (const int other : cells_at_.at(found.key)) {
        if (is_halved_[other] != 0) continue;
        const OrderedEdge longest = longest_edge(other);
        if (!(found < longest)) continue;
        found = longest;
        goes_on = true;
        break;
      }
    }
    return found;
  }

  int add_node(const Point& x) {
    mesh_.nodes.push_back(x);
    return static_cast<int>(mesh_.nodes.size()) - 1;
  }

  void halve_around(const OrderedEdge& edge) {
    int middle = 0;
    if constexpr (Order == 1)
      middle = add_node(0.5 * (mesh_.nodes[edge.a] + mesh_.nodes[edge.b]));
    else
      middle = middles_.at(edge.a, edge.b);
    const auto around = cells_at_.at(edge.key);  // a copy: lists grow
    for (const int c : around)
      if (is_halved_[c] == 0) halve(c, edge, middle);
    cells_at_.erase(edge.key);
    const auto facets = facets_at_.find(edge.key);
    if (facets == facets_at_.end()) return;
    const auto places = std::move(facets->second);
    facets_at_.erase(facets);
    for (const auto& [group, f] : places) halve_facet(group, f, edge, middle);
  }

  void halve(int c, const OrderedEdge& edge, int middle) {
    const Cell cell = mesh_.cells[c];
    is_halved_[c] = 1;
    for (const int replaced : {edge.b, edge.a}) {
      Cell half = cell;
      const auto at = static_cast<int>(std::find(cell.begin(), cell.begin() + Dim + 1, replaced) - cell.begin());
      half[at] = middle;
      if constexpr (Order == 2) set_middles(cell, at, middle, half);
      require_upright<Dim, Order>(mesh_.nodes, half, 1, file_);
      mesh_.cells.push_back(half);
      mesh_.cell_region.push_back(mesh_.cell_region[c]);
      weights_.push_back(weights_[c] * plan_.shrinkage);
      is_halved_.push_back(0);
      list(static_cast<int>(mesh_.cells.size()) - 1);
    }
  }

  /// The middles of a half's edges that end at the new vertex, on the cell's own curves and faces.
  /// \param at  place of the new vertex in the half
  void set_middles(const Cell& cell, int at, int middle, Cell& half) {
    const auto place_of_middle = static_cast<int>(std::find(cell.begin() + Dim + 1, cell.end(), middle) - cell.begin());
    for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
      const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
      if (a != at && b != at) continue;
      const int other = a == at ? b : a;
      const auto [node, is_new] = middles_.find_or_add(middle, half[other], static_cast<int>(mesh_.nodes.size()));
      if (is_new) mesh_.nodes.push_back(point_between<Dim>(mesh_.nodes, cell, place_of_middle, other));
      half[Dim + 1 + e] = node;
    }
  }

  void halve_facet(std::size_t group, std::size_t f, const OrderedEdge& edge, int middle) {
    auto& facets = mesh_.facet_groups[group].facets;
    const Facet whole = facets[f];
    const auto find = [&](int node) { return std::find(whole.begin(), whole.begin() + Dim, node) - whole.begin(); };
    const auto a = find(edge.a), b = find(edge.b);
    if (a == Dim || b == Dim) return;  // an older entry: the facet there now is another one
    std::array<Facet, 2> halves{whole, whole};
    halves[0][b] = middle;
    halves[1][a] = middle;
    if constexpr (Order == 2)
      for (auto& half : halves)
        for (std::size_t e = 0; e < SimplexEdges<Dim - 1>::vertices.size(); ++e) {
          const auto& [i, j] = SimplexEdges<Dim - 1>::vertices[e];
          half[Dim + e] = middles_.at(half[i], half[j]);
        }
    facets[f] = halves[0];
    facets.push_back(halves[1]);
    list_facet(group, f);
    list_facet(group, facets.size() - 1);
  }

  Mesh compact() {
    std::size_t to = 0;
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      if (is_halved_[c] != 0) continue;
      mesh_.cells[to] = mesh_.cells[c];
      mesh_.cell_region[to++] = mesh_.cell_region[c];
    }
    mesh_.cells.resize(to);
    mesh_.cell_region.resize(to);
    return std::move(mesh_);
  }

  std::string file_;
  const BisectionPlan& plan_;
  Mesh mesh_;
  std::vector<double> weights_;  ///< per cell
  std::vector<char> is_halved_;  ///< per cell: its halves stand behind it
  std::priority_queue<std::pair<double, int>> heaviest_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_at_;                                   ///< by edge
  std::unordered_map<std::uint64_t, std::vector<std::pair<std::size_t, std::size_t>>> facets_at_;  ///< group, place
  EdgeMiddles middles_;  ///< of quadratic cells
};

/// Bytes per node that making, writing and reading again takes. Measured as peak memory in three dimensions: 1,350 for
/// straight cells, 560 for quadratic ones; in two reckoned from uniform refinement's.
constexpr double bytes_per_node(int dim, int order) {
  return order == 1 ? (dim == 3 ? 1700 : 600) : (dim == 3 ? 700 : 400);
}

}  // namespace

template <int Dim, int Order>
SimplexMesh<Dim, Order> bisect(const SimplexMesh<Dim, Order>& mesh, const BisectionPlan& plan,
                               const std::string& file) {
  const double bytes = bytes_per_node(Dim, Order) * static_cast<double>(plan.most_nodes);
  if (const auto room = available_memory(); bytes > static_cast<double>(room.bytes))
    throw OutOfMemory(fmt::format("a mesh of {} nodes takes some {}", plan.most_nodes, memory_text(bytes)),
                      "ask for fewer nodes");
  return Bisection<Dim, Order>(mesh, plan, file).halve_heaviest();
}

#define INSTANTIATE(Dim, Order) \
  template SimplexMesh<Dim, Order> bisect(const SimplexMesh<Dim, Order>&, const BisectionPlan&, const std::string&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
