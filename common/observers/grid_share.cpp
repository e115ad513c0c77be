#include "observers/grid_share.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "fem/dimensions.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "parallel/even_stretch.hpp"

namespace fsi {

template <int n>
std::vector<Middle> separate_middles(FieldGrid& grid) {
  std::vector<Middle> middles;
  if (grid.nodes_per_cell != nodes_of_simplex(n, 2)) return middles;
  std::vector<std::vector<std::size_t>> at(grid.points.size());  // places in `middles` by node
  for (std::size_t cell = 0; cell < grid.cells.size(); cell += grid.nodes_per_cell)
    for (std::size_t edge = 0; edge < SimplexEdges<n>::vertices.size(); ++edge) {
      int& point = grid.cells[cell + n + 1 + edge];
      const auto& [a, b] = SimplexEdges<n>::vertices[edge];
      const auto [first, second] = std::minmax(grid.cells[cell + a], grid.cells[cell + b]);
      const std::array<int, 2> ends{first, second};
      auto& known = at[point];
      const auto found =
          std::find_if(known.begin(), known.end(), [&](std::size_t k) { return middles[k].ends == ends; });
      if (found != known.end()) {
        point = middles[*found].point;
        continue;
      }
      const int node = point;
      if (!known.empty()) {
        point = static_cast<int>(grid.points.size());
        grid.points.push_back(grid.points[node]);
      }
      known.push_back(middles.size());
      middles.push_back({point, node, ends});
    }
  return middles;
}

template <int n>
GridShare share_out(FieldGrid& whole, const PartNodes& here) {
  const NodeShare& share = *here.share;
  const Communicator& processes = *share.processes;
  assert(whole.points.size() == static_cast<std::size_t>(share.whole_nodes));
  std::vector<int> local(whole.points.size(), -1);
  for (int a = 0; a < here.node_count(); ++a) local[share.whole_node[a]] = a;

  std::vector<std::int64_t> places(share.whole_node.begin(), share.whole_node.end());
  std::vector<char> owned = share.owned;
  std::vector<Middle> middles;
  for (const Middle& middle : separate_middles<n>(whole)) {
    const int node = local[middle.node];
    if (node < 0 || share.owned[node] == 0) continue;
    // All cells around an own node are here, and so the ends of its edge.
    Middle mine{node, node, {local[middle.ends[0]], local[middle.ends[1]]}};
    assert(mine.ends[0] >= 0 && mine.ends[1] >= 0);
    if (middle.point != middle.node) {
      mine.point = static_cast<int>(places.size());
      places.push_back(middle.point);
      owned.push_back(1);
    }
    middles.push_back(mine);
  }
  GridShare mine{std::move(middles),
                 WholeOrder(processes, std::move(places), owned, static_cast<std::int64_t>(whole.points.size()))};

  const auto corners = static_cast<std::ptrdiff_t>(whole.nodes_per_cell);
  const auto cells = static_cast<std::int64_t>(cells_here(whole));
  const EvenStretch mine_of_cells(cells, processes);
  whole.stretch = FieldGrid::Stretch{static_cast<std::uint64_t>(mine.order.first()), whole.points.size(),
                                     static_cast<std::uint64_t>(mine_of_cells.first), static_cast<std::uint64_t>(cells),
                                     !whole.layer.empty()};
  const auto keep = [](auto& list, std::ptrdiff_t from, std::ptrdiff_t to) {
    list =
        std::decay_t<decltype(list)>(list.begin() + from, list.begin() + to);  // the memory of the rest is given back
  };
  keep(whole.points, mine.order.first(), mine.order.first() + mine.order.count());
  keep(whole.cells, mine_of_cells.first * corners, mine_of_cells.last * corners);
  if (!whole.layer.empty()) keep(whole.layer, mine_of_cells.first, mine_of_cells.last);
  return mine;
}

#define FSI_INSTANTIATE(n)                                      \
  template std::vector<Middle> separate_middles<n>(FieldGrid&); \
  template GridShare share_out<n>(FieldGrid&, const PartNodes&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
