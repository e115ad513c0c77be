#include "scene/pressure_equations.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include "fem/elements.hpp"

namespace fsi {

namespace {

/// Each pressure takes a free component of the velocity at a node of its cells. Those of a vertex's own node come first, and
/// nearly all find one there; the others are looked for along alternating paths.
template <class Element>
class PressureMatching {
  using Part = Submesh<Element::dim, Element::order>;

 public:
  PressureMatching(const Part& fluid, std::vector<int> free) : fluid_(fluid), left_(std::move(free)) {
    first_.assign(fluid.nodes.size() + 1, 0);
    for (const auto& cell : fluid.cells)
      for (int a = 0; a < Element::scalar_nodes; ++a) ++first_[static_cast<std::size_t>(cell[a]) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    cells_.resize(static_cast<std::size_t>(first_.back()));
    auto next = first_;
    for (std::size_t c = 0; c < fluid.cells.size(); ++c)
      for (int a = 0; a < Element::scalar_nodes; ++a) cells_[next[fluid.cells[c][a]]++] = static_cast<int>(c);
  }

  /// The vertices of a set without enough velocities; empty: all have one.
  std::vector<int> unmatched_set() {
    std::vector<int> waiting;
    for (std::size_t v = 0; v < fluid_.nodes.size(); ++v) {
      if (first_[v] == first_[v + 1]) continue;  // no vertex
      if (left_[v] > 0)
        take(static_cast<int>(v), static_cast<int>(v));
      else
        waiting.push_back(static_cast<int>(v));
    }
    for (const int vertex : waiting)
      if (auto reached = search(vertex); !reached.empty()) return reached;
    return {};
  }

  /// The nodes of all cells around vertices, and those cells.
  void around(const std::vector<int>& vertices, std::unordered_set<int>& nodes, std::unordered_set<int>& cells) const {
    for (const int v : vertices)
      for (int i = first_[v]; i < first_[v + 1]; ++i)
        if (cells.insert(cells_[i]).second)
          nodes.insert(fluid_.cells[cells_[i]].begin(), fluid_.cells[cells_[i]].end());
  }

 private:
  void take(int vertex, int node) {
    --left_[node];
    taken_by_[node].push_back(vertex);
    node_of_[vertex] = node;
  }

  /// Breadth first from a vertex without a partner; the vertices reached if no path ends at a free component.
  std::vector<int> search(int start) {
    std::vector<int> reached{start};
    std::unordered_map<int, int> from;  // node: the vertex that came to it
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const int vertex = reached[i];
      for (int c = first_[vertex]; c < first_[vertex + 1]; ++c)
        for (const int node : fluid_.cells[cells_[c]]) {
          if (!from.try_emplace(node, vertex).second) continue;
          if (left_[node] > 0) {
            turn_over(node, start, from);
            return {};
          }
          if (const auto taken = taken_by_.find(node); taken != taken_by_.end())
            reached.insert(reached.end(), taken->second.begin(), taken->second.end());
        }
    }
    return reached;
  }

  /// Along the path that ends at a node with a component left every vertex takes the next node.
  void turn_over(int node, int start, const std::unordered_map<int, int>& from) {
    while (true) {
      const int vertex = from.at(node);
      const int before = vertex == start ? -1 : node_of_.at(vertex);
      if (before >= 0) {
        auto& others = taken_by_[before];
        others.erase(std::find(others.begin(), others.end(), vertex));
        ++left_[before];
      }
      take(vertex, node);
      if (before < 0) return;
      node = before;
    }
  }

  const Part& fluid_;
  std::vector<int> left_;           ///< per node, free components that no pressure has taken
  std::vector<int> first_, cells_;  ///< cells of each vertex
  std::unordered_map<int, std::vector<int>> taken_by_;
  std::unordered_map<int, int> node_of_;
};

}  // namespace

template <class Element>
std::optional<LostPressures> lost_pressures(const Submesh<Element::dim, Element::order>& fluid,
                                            const DirichletConditions<Element::components>& velocity,
                                            const std::vector<int>& given) {
  if constexpr (Element::order == 1) {
    return std::nullopt;  // stabilised: the pressures' own Laplacian stands beside the continuity
  } else {
    std::vector<int> free(fluid.nodes.size(), 0);
    for (int a = 0; a < fluid.node_count(); ++a)
      for (int k = 0; k < Element::components; ++k) free[a] += velocity.fixes(a, k) ? 0 : 1;
    for (const int node : given) free[node] = 0;
    PressureMatching<Element> matching(fluid, free);
    const auto vertices = matching.unmatched_set();
    if (vertices.empty()) return std::nullopt;
    std::unordered_set<int> nodes, cells;
    matching.around(vertices, nodes, cells);
    LostPressures lost{fluid.nodes[vertices.front()], static_cast<int>(vertices.size()), 0,
                       static_cast<int>(cells.size())};
    for (const int node : nodes) lost.velocities += free[node];
    return lost;
  }
}

#define FSI_INSTANTIATE(Element)                                                                                 \
  template std::optional<LostPressures> lost_pressures<Element>(const Submesh<Element::dim, Element::order>&,    \
                                                                const DirichletConditions<Element::components>&, \
                                                                const std::vector<int>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
