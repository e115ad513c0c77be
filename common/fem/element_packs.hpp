#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "algebra/node_graph.hpp"
#include "host/threads.hpp"
#include "math/tensor.hpp"

namespace fsi {

/// The elements of one sub-problem (or of one wall layer) made ready for vectorised, threaded assembly: packs of
/// elements with their constant geometry and the stored positions of their blocks in the sparse matrices.
///
/// Threads own rows, not elements: thread t adds only to the rows of its range of nodes and visits every pack that
/// touches one of them, so packs on the border of two ranges are evaluated by both. No two threads write to one place
/// and nothing is coloured or locked. Elements are packed once, in their order and whatever the number of threads, so
/// that every entry is summed in one order: results do not depend on the number of threads. Processes own
/// rows in the same way: they hold all elements that touch one of theirs.
template <class Element>
class ElementPacks {
 public:
  using ElementType = Element;
  static constexpr int nodes = Element::nodes;
  using Lanes = std::array<int, pack_width>;

  struct ElementPack {
    typename Element::Geometry geometry;
    Lanes node[nodes];                     ///< node numbers; empty lanes repeat the last element
    Lanes position[nodes * nodes];         ///< block (a, b) in the graph; -1: not this thread's row, or an empty lane
    Lanes cell;                            ///< element numbers, as in the submesh
    int number;                            ///< among all packs, whatever the number of threads
    int filled;                            ///< lanes that are not empty
    std::array<bool, pack_width> counted;  ///< by this process, of the filled ones, in sums over elements

    /// Whether this copy of the pack is the one that sums over elements count: true on exactly one thread.
    bool counted_here() const { return position[0][0] >= 0; }
  };

  /// \param node_positions  reference coordinates, mm
  /// \param cells           all cells of the submesh; `subset` lists those to take
  /// \param graph           the node graph that matrices are stored on
  /// \param counted         per cell, whether sums count it on this process (Submesh::counted); empty: all
  template <class Point, class Cell>
  ElementPacks(const std::vector<Point>& node_positions, const std::vector<Cell>& cells, const std::vector<int>& subset,
               const NodeGraph& graph, const std::vector<char>& counted = {})
      : packs_of_thread_(threads()) {
    const int thread_count = threads();
    const int node_count = static_cast<int>(node_positions.size());
    for (int t = 0; t < thread_count; ++t) {
      const int first = static_cast<int>(static_cast<long>(node_count) * t / thread_count);
      const int last = static_cast<int>(static_cast<long>(node_count) * (t + 1) / thread_count);
      const auto touches = [&](int cell) {
        return std::any_of(cells[cell].begin(), cells[cell].end(), [&](int n) { return n >= first && n < last; });
      };
      const auto group = [&](std::size_t begin) {
        const auto at = [&](std::size_t i) { return subset.begin() + static_cast<std::ptrdiff_t>(i); };
        return std::pair(at(begin), at(std::min(begin + pack_width, subset.size())));
      };
      std::vector<std::size_t> begins;  // of the packs that touch this thread's rows
      for (std::size_t begin = 0; begin < subset.size(); begin += pack_width)
        if (const auto [from, to] = group(begin); std::any_of(from, to, touches)) begins.push_back(begin);
      packs_of_thread_[t].reserve(begins.size());
      for (const std::size_t begin : begins) {
        const auto [from, to] = group(begin);
        auto& pack = packs_of_thread_[t].emplace_back();
        fill(pack, std::vector<int>(from, to), node_positions, cells, graph, first, last);
        for (int lane = 0; lane < pack_width; ++lane)
          pack.counted[lane] = counted.empty() || counted[pack.cell[lane]] != 0;
        pack.number = static_cast<int>(begin / pack_width);
      }
    }
    element_count_ = subset.size();
  }

  std::size_t element_count() const { return element_count_; }
  std::size_t pack_count() const { return (element_count_ + pack_width - 1) / pack_width; }
  int thread_count() const { return static_cast<int>(packs_of_thread_.size()); }
  const std::vector<ElementPack>& of_thread(int t) const { return packs_of_thread_[t]; }

  /// Takes the elements' sizes h, where they have one, from packs of the same elements at other node positions.
  void keep_sizes_of(const ElementPacks& others) {
    if constexpr (Element::stabilised)
      for (std::size_t t = 0; t < packs_of_thread_.size(); ++t)
        for (std::size_t i = 0; i < packs_of_thread_[t].size(); ++i)
          packs_of_thread_[t][i].geometry.size_squared = others.packs_of_thread_[t][i].geometry.size_squared;
  }

 private:
  template <class Point, class Cell>
  static void fill(ElementPack& pack, const std::vector<int>& elements, const std::vector<Point>& x,
                   const std::vector<Cell>& cells, const NodeGraph& graph, int first, int last) {
    Vec3<Pack> corner[nodes];
    pack.filled = static_cast<int>(elements.size());
    for (int lane = 0; lane < pack_width; ++lane) {
      const bool empty = lane >= static_cast<int>(elements.size());
      const int c = empty ? elements.back() : elements[lane];
      pack.cell[lane] = c;
      for (int a = 0; a < nodes; ++a) {
        const int node = cells[c][a];
        pack.node[a][lane] = node;
        for (int i = 0; i < 3; ++i) corner[a][i].set(lane, x[node][i]);
        const bool owned = !empty && node >= first && node < last;
        for (int b = 0; b < nodes; ++b) pack.position[a * nodes + b][lane] = owned ? graph.find(node, cells[c][b]) : -1;
      }
    }
    pack.geometry = Element::geometry(corner);
  }

  std::vector<std::vector<ElementPack>> packs_of_thread_;
  std::size_t element_count_ = 0;
};

/// Numbers of linear tetrahedra below which a loop runs on one thread: loops that evaluate residuals only (some 20
/// million elements a second), that sum energies (half as fast) and that differentiate (some 500,000 a second). Other
/// elements count by the square of their nodes: a quadratic tetrahedron as six (it takes eight times as long).
inline constexpr std::size_t serial_residual_elements = 20000, serial_sum_elements = 10000,
                             serial_jacobian_elements = 500;

/// Runs visit(thread, packs of that thread) for every thread's packs, on all threads unless there are fewer elements
/// than `serial_below` linear tetrahedra. The numbers assembled do not depend on that choice.
template <class Element, class Visit>
void for_each_thread(const ElementPacks<Element>& packs, std::size_t serial_below, Visit visit) {
  constexpr std::size_t work = Element::nodes * Element::nodes, of_linear_tetrahedron = 16;
  const int count = packs.thread_count();
  const bool worth_it = packs.element_count() * work >= serial_below * of_linear_tetrahedron;
#pragma omp parallel for schedule(static, 1) num_threads(count) if (worth_it)
  for (int t = 0; t < count; ++t) visit(t, packs.of_thread(t));
}

}  // namespace fsi
