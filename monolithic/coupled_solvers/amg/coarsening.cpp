#include "monolithic/coupled_solvers/amg/coarsening.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "base/error.hpp"
#include "base/names.hpp"

namespace fsi {

namespace {

enum class Colour : char { undecided, coarse, fine };

/// Chooses coarse nodes among the undecided candidates: an independent set, every candidate covered. The choice
/// advances as a front (the next node is one two edges away from a coarse node), which packs coarse nodes densely and
/// evenly. \param covers  covers(coarse, fine): the fine node may interpolate from the coarse one
template <class Candidate, class Covers>
void colour_nodes(const NodeGraph& graph, std::vector<Colour>& colour, Candidate candidate, Covers covers) {
  std::vector<int> front;
  std::size_t next = 0;
  const auto choose = [&](int node) {
    colour[node] = Colour::coarse;
    for (int at = graph.offsets[node]; at < graph.offsets[node + 1]; ++at) {
      const int neighbour = graph.columns[at];
      if (colour[neighbour] != Colour::undecided || !covers(node, neighbour)) continue;
      colour[neighbour] = Colour::fine;
      for (int b = graph.offsets[neighbour]; b < graph.offsets[neighbour + 1]; ++b)
        if (colour[graph.columns[b]] == Colour::undecided) front.push_back(graph.columns[b]);
    }
  };
  for (int start = 0; start < graph.rows(); ++start) {
    if (colour[start] == Colour::undecided && candidate(start)) choose(start);
    while (next < front.size()) {
      const int node = front[next++];
      if (colour[node] == Colour::undecided && candidate(node)) choose(node);
    }
  }
}

/// Disjoint aggregates around nodes all of whose neighbours are still free; what is left joins the neighbouring
/// aggregate it has most couplings with, or makes an aggregate of its own.
/// \param aggregate  -1: free; -2: not to be touched; others: given aggregates. \param joins  joins(node, aggregate's
/// member): the node may belong to that member's aggregate
template <class Candidate, class Joins>
void aggregate_nodes(const NodeGraph& graph, std::vector<int>& aggregate, std::vector<int>& roots, Candidate candidate,
                     Joins joins) {
  const int nodes = graph.rows();
  for (int root = 0; root < nodes; ++root) {
    if (aggregate[root] != -1 || !candidate(root)) continue;
    bool all_free = true;
    for (int at = graph.offsets[root]; at < graph.offsets[root + 1] && all_free; ++at) {
      const int j = graph.columns[at];
      all_free = aggregate[j] == -1 || !joins(j, root);
    }
    if (!all_free) continue;
    for (int at = graph.offsets[root]; at < graph.offsets[root + 1]; ++at) {
      const int j = graph.columns[at];
      if (aggregate[j] == -1 && joins(j, root)) aggregate[j] = static_cast<int>(roots.size());
    }
    aggregate[root] = static_cast<int>(roots.size());
    roots.push_back(root);
  }
  std::vector<int> joined = aggregate;
  std::vector<std::pair<int, int>> links;  // (aggregate, couplings)
  for (int i = 0; i < nodes; ++i) {
    if (aggregate[i] != -1 || !candidate(i)) continue;
    links.clear();
    for (int at = graph.offsets[i]; at < graph.offsets[i + 1]; ++at) {
      const int j = graph.columns[at];
      if (j == i || aggregate[j] < 0 || !joins(i, j)) continue;
      const auto known = std::find_if(links.begin(), links.end(), [&](auto& l) { return l.first == aggregate[j]; });
      if (known == links.end())
        links.push_back({aggregate[j], 1});
      else
        ++known->second;
    }
    if (links.empty()) continue;
    joined[i] =
        std::max_element(links.begin(), links.end(), [](auto& a, auto& b) { return a.second < b.second; })->first;
  }
  aggregate = joined;
  for (int i = 0; i < nodes; ++i) {
    if (aggregate[i] != -1 || !candidate(i)) continue;
    for (int at = graph.offsets[i]; at < graph.offsets[i + 1]; ++at) {
      const int j = graph.columns[at];
      if (aggregate[j] == -1 && candidate(j) && joins(j, i)) aggregate[j] = static_cast<int>(roots.size());
    }
    aggregate[i] = static_cast<int>(roots.size());
    roots.push_back(i);
  }
}

using Row = std::vector<std::pair<int, double>>;  // (coarse node, weight)

/// Renumbers coarse nodes by the first fine node that reaches them, which keeps the locality of the fine numbering, and
/// makes the CSR form. Returns new numbers of the old coarse nodes.
std::vector<int> store_rows(std::vector<Row>& rows, const std::vector<int>& seeds, NodeTransfer& transfer) {
  std::vector<int> number(seeds.size(), -1);
  int next = 0;
  for (const auto& row : rows)
    for (const auto& entry : row)
      if (number[entry.first] < 0) number[entry.first] = next++;
  transfer.coarse_nodes = next;
  transfer.seeds.resize(next);
  for (std::size_t c = 0; c < seeds.size(); ++c) transfer.seeds[number[c]] = seeds[c];
  transfer.graph.offsets.assign(1, 0);
  transfer.graph.columns.clear();
  transfer.weights.clear();
  for (auto& row : rows) {
    for (auto& entry : row) entry.first = number[entry.first];
    std::sort(row.begin(), row.end());
    for (const auto& entry : row) {
      transfer.graph.columns.push_back(entry.first);
      transfer.weights.push_back(entry.second);
    }
    transfer.graph.offsets.push_back(static_cast<int>(transfer.graph.columns.size()));
  }
  return number;
}

}  // namespace

NodeGraph interface_graph(const NodeGraph& first, const std::vector<int>& first_nodes, const NodeGraph& second,
                          const std::vector<int>& second_nodes) {
  std::vector<int> index(first.rows(), -1);
  for (std::size_t k = 0; k < first_nodes.size(); ++k) index[first_nodes[k]] = static_cast<int>(k);
  NodeGraph graph;
  graph.offsets.assign(1, 0);
  for (std::size_t k = 0; k < first_nodes.size(); ++k) {
    const std::size_t begin = graph.columns.size();
    const int row = first_nodes[k];
    for (int at = first.offsets[row]; at < first.offsets[row + 1]; ++at) {
      const int other = index[first.columns[at]];
      if (other >= 0 && second.find(second_nodes[k], second_nodes[other]) >= 0) graph.columns.push_back(other);
    }
    std::sort(graph.columns.begin() + static_cast<std::ptrdiff_t>(begin), graph.columns.end());
    graph.offsets.push_back(static_cast<int>(graph.columns.size()));
  }
  return graph;
}

NodeTransfer coarsen_interface(const NodeGraph& surface, const std::vector<char>& prescribed, CoarseningKind kind) {
  NodeMarks marks(surface.rows());
  marks.prescribed = prescribed;
  CoarseningOptions options;
  options.kind = kind;
  NodeTransfer empty;
  empty.graph.offsets.assign(1, 0);
  return extend_interface(surface, marks, {}, empty, options).transfer;
}

Coarsening extend_interface(const NodeGraph& strong, const NodeMarks& marks, const std::vector<int>& interface_nodes,
                            const NodeTransfer& surface, const CoarseningOptions& options) {
  const int nodes = strong.rows();
  std::vector<char> given(nodes, 0);
  for (int node : interface_nodes) given[node] = 1;
  std::vector<Row> rows(nodes);
  for (std::size_t k = 0; k < interface_nodes.size(); ++k)
    for (int at = surface.graph.offsets[k]; at < surface.graph.offsets[k + 1]; ++at)
      rows[interface_nodes[k]].push_back({surface.graph.columns[at], surface.weights[at]});
  std::vector<int> seeds;  // fine node of each coarse node, numbered as in `rows`
  for (int k : surface.seeds) seeds.push_back(interface_nodes[k]);

  const bool mixed = options.interior_from_interface;
  const auto free = [&](int i) { return !given[i] && !marks.prescribed[i]; };
  const auto remaining = [&](int i) { return !given[i] && (options.scalar_part || !marks.prescribed[i]); };
  if (options.kind == CoarseningKind::colouring) {
    std::vector<int> coarse_at(nodes, -1);
    std::vector<Colour> colour(nodes, Colour::undecided);
    for (int i : interface_nodes) colour[i] = Colour::fine;
    for (std::size_t c = 0; c < seeds.size(); ++c) coarse_at[seeds[c]] = static_cast<int>(c);
    for (int i : interface_nodes) {
      if (coarse_at[i] < 0) continue;
      colour[i] = Colour::coarse;
      if (!mixed) continue;
      for (int at = strong.offsets[i]; at < strong.offsets[i + 1]; ++at)
        if (colour[strong.columns[at]] == Colour::undecided) colour[strong.columns[at]] = Colour::fine;
    }
    const auto covers = [&](int, int fine) { return !given[fine]; };
    colour_nodes(strong, colour, free, covers);
    colour_nodes(strong, colour, remaining, covers);
    for (int i = 0; i < nodes; ++i)
      if (!given[i] && colour[i] == Colour::coarse) {
        coarse_at[i] = static_cast<int>(seeds.size());
        seeds.push_back(i);
      }
    for (int i = 0; i < nodes; ++i) {
      if (!remaining(i)) continue;
      if (coarse_at[i] >= 0) {
        rows[i].push_back({coarse_at[i], 1.0});
        continue;
      }
      for (int at = strong.offsets[i]; at < strong.offsets[i + 1]; ++at) {
        const int j = strong.columns[at];
        if (coarse_at[j] >= 0 && (mixed || !given[j])) rows[i].push_back({coarse_at[j], 1.0});
      }
      for (auto& entry : rows[i]) entry.second = 1.0 / static_cast<double>(rows[i].size());
    }
  } else {
    std::vector<int> aggregate(nodes, -1);
    for (int i : interface_nodes) aggregate[i] = rows[i].size() == 1 ? rows[i][0].first : -2;
    const auto joins = [&](int node, int member) { return !given[node] && (mixed || !given[member]); };
    aggregate_nodes(strong, aggregate, seeds, free, joins);
    aggregate_nodes(strong, aggregate, seeds, remaining, joins);
    for (int i = 0; i < nodes; ++i)
      if (remaining(i)) rows[i].push_back({aggregate[i], 1.0});
  }

  Coarsening result;
  const auto number = store_rows(rows, seeds, result.transfer);
  result.transfer.fine_prescribed = marks.prescribed;
  result.transfer.complete();
  result.marks = NodeMarks(result.transfer.coarse_nodes);
  result.marks.prescribed = result.transfer.coarse_prescribed;
  result.coarse_interface.assign(number.begin(), number.begin() + surface.coarse_nodes);
  for (int c : result.coarse_interface) result.marks.interface[c] = 1;
  return result;
}

Coarsening coarsen(const NodeGraph& strong, const NodeMarks& marks, const CoarseningOptions& options) {
  std::vector<int> interface_nodes;
  std::vector<char> prescribed;
  for (int i = 0; i < strong.rows(); ++i)
    if (marks.interface[i] && (options.scalar_part || !marks.prescribed[i])) {
      interface_nodes.push_back(i);
      prescribed.push_back(marks.prescribed[i]);
    }
  const NodeGraph surface = interface_graph(strong, interface_nodes, strong, interface_nodes);
  return extend_interface(strong, marks, interface_nodes, coarsen_interface(surface, prescribed, options.kind),
                          options);
}

template <int Size>
NodeGraph strong_graph(const BlockMatrix<Size, Size>& a, int vector, double threshold) {
  const NodeGraph& graph = *a.graph;
  if (threshold <= 0) return graph;
  const auto square = [&](int at) {
    double sum = 0;
    for (int r = 0; r < vector; ++r)
      for (int c = 0; c < vector; ++c) sum += a.block(at)[r * Size + c] * a.block(at)[r * Size + c];
    return sum;
  };
  std::vector<double> diagonal(graph.rows());
  for (int i = 0; i < graph.rows(); ++i) diagonal[i] = std::sqrt(square(graph.find(i, i)));
  std::vector<char> keep(graph.blocks(), 0);
  for (int i = 0; i < graph.rows(); ++i)
    for (int at = graph.offsets[i]; at < graph.offsets[i + 1]; ++at) {
      const int j = graph.columns[at];
      if (i != j && square(at) <= threshold * threshold * diagonal[i] * diagonal[j]) continue;
      keep[at] = 1;
      const int back = graph.find(j, i);
      if (back >= 0) keep[back] = 1;
    }
  NodeGraph strong;
  strong.offsets.assign(1, 0);
  for (int i = 0; i < graph.rows(); ++i) {
    for (int at = graph.offsets[i]; at < graph.offsets[i + 1]; ++at)
      if (keep[at]) strong.columns.push_back(graph.columns[at]);
    strong.offsets.push_back(static_cast<int>(strong.columns.size()));
  }
  return strong;
}
template NodeGraph strong_graph<1>(const BlockMatrix<1, 1>&, int, double);
template NodeGraph strong_graph<3>(const BlockMatrix<3, 3>&, int, double);
template NodeGraph strong_graph<4>(const BlockMatrix<4, 4>&, int, double);

template <int Numbers>
NodeTransfer smoothed(const BlockMatrix<1, Numbers>& a, const NodeMarks& marks, const NodeTransfer& tentative,
                      const CoarseningOptions& options, double omega) {
  const NodeGraph& graph = *a.graph;
  const auto number = [&](int at) {
    double sum = 0;
    for (int k = 0; k < Numbers; ++k) sum += a.block(at)[k];
    return sum / Numbers;
  };
  NodeTransfer result;
  result.coarse_nodes = tentative.coarse_nodes;
  result.fine_prescribed = tentative.fine_prescribed;
  result.seeds = tentative.seeds;
  result.graph.offsets.assign(1, 0);
  std::vector<double> sum(tentative.coarse_nodes, 0.0);
  std::vector<char> seen(tentative.coarse_nodes, 0);
  std::vector<int> columns;
  for (int i = 0; i < graph.rows(); ++i) {
    columns.clear();
    const auto add = [&](int node, double factor) {
      for (int b = tentative.graph.offsets[node]; b < tentative.graph.offsets[node + 1]; ++b) {
        const int c = tentative.graph.columns[b];
        if (!seen[c]) columns.push_back(c);
        seen[c] = 1;
        sum[c] += factor * tentative.weights[b];
      }
    };
    const bool own_row = tentative.graph.offsets[i] < tentative.graph.offsets[i + 1];
    add(i, 1.0);
    if (own_row && !marks.prescribed[i] && !marks.interface[i]) {
      // Forbidden couplings are lumped on the diagonal, which keeps constants interpolated exactly.
      double diagonal = 0;
      for (int at = graph.offsets[i]; at < graph.offsets[i + 1]; ++at) {
        const int j = graph.columns[at];
        if (j == i || (marks.interface[j] && !options.interior_from_interface)) diagonal += number(at);
      }
      for (int at = graph.offsets[i]; at < graph.offsets[i + 1]; ++at) {
        const int j = graph.columns[at];
        if (j == i)
          add(i, -omega);
        else if (!(marks.interface[j] && !options.interior_from_interface) && number(at) != 0)
          add(j, -omega * number(at) / diagonal);
      }
    }
    std::sort(columns.begin(), columns.end());
    for (int c : columns) {
      result.graph.columns.push_back(c);
      result.weights.push_back(sum[c]);
      sum[c] = 0;
      seen[c] = 0;
    }
    result.graph.offsets.push_back(static_cast<int>(result.graph.columns.size()));
  }
  result.complete();
  return result;
}
template NodeTransfer smoothed<1>(const BlockMatrix<1, 1>&, const NodeMarks&, const NodeTransfer&,
                                  const CoarseningOptions&, double);
template NodeTransfer smoothed<2>(const BlockMatrix<1, 2>&, const NodeMarks&, const NodeTransfer&,
                                  const CoarseningOptions&, double);
template NodeTransfer smoothed<3>(const BlockMatrix<1, 3>&, const NodeMarks&, const NodeTransfer&,
                                  const CoarseningOptions&, double);

RowColours colour_rows(const NodeGraph& graph) {
  const int rows = graph.rows();
  std::vector<int> colour(rows, -1), taken;
  int colours = 0;
  for (int i = 0; i < rows; ++i) {
    taken.assign(colours + 1, 0);
    for (int at = graph.offsets[i]; at < graph.offsets[i + 1]; ++at)
      if (colour[graph.columns[at]] >= 0) taken[colour[graph.columns[at]]] = 1;
    colour[i] = static_cast<int>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
    colours = std::max(colours, colour[i] + 1);
  }
  RowColours result;
  result.offsets.assign(colours + 1, 0);
  for (int c : colour) ++result.offsets[c + 1];
  for (int c = 0; c < colours; ++c) result.offsets[c + 1] += result.offsets[c];
  result.rows.resize(rows);
  std::vector<int> next(result.offsets.begin(), result.offsets.end() - 1);
  for (int i = 0; i < rows; ++i) result.rows[next[colour[i]]++] = i;
  return result;
}

}  // namespace fsi
