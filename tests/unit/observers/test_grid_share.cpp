#include "observers/grid_share.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "parallel/communicator.hpp"

namespace fsi::test {

namespace {

/// Two quadratic triangles of two layers: they have the middle node 6 in common, but vertices of their own at its ends.
FieldGrid two_layers() {
  FieldGrid grid;
  grid.name = "wall";
  for (int a = 0; a < 11; ++a) grid.points.push_back({a + 0.5, 2.0 * a, 0});
  grid.nodes_per_cell = 6;
  grid.cells = {0, 1, 2, 7, 6, 8, 3, 4, 5, 6, 9, 10};
  grid.layer = {4, 5};
  return grid;
}

/// All nodes are here, own or copies; the owners alternate, and with three processes the last one owns nothing.
PartNodes part_of(const FieldGrid& grid, const Communicator& processes) {
  auto share = std::make_shared<NodeShare>();
  share->processes = &processes;
  share->whole_nodes = static_cast<std::int64_t>(grid.points.size());
  PartNodes part;
  part.nodes = grid.points;
  for (int a = 0; a < part.node_count(); ++a) {
    share->whole_node.push_back(a);
    share->owned.push_back(a % std::min(2, processes.size()) == processes.rank() ? 1 : 0);
  }
  part.share = share;
  return part;
}

/// A field that is a * a at node a, and at the middles of edges the mean of their ends.
std::vector<double> field(std::size_t points, const std::vector<Middle>& middles) {
  std::vector<double> values(points);
  for (std::size_t a = 0; a < points; ++a) values[a] = static_cast<double>(a * a);
  for (const Middle& middle : middles)
    values[static_cast<std::size_t>(middle.point)] =
        0.5 * (values[static_cast<std::size_t>(middle.ends[0])] + values[static_cast<std::size_t>(middle.ends[1])]);
  return values;
}

TEST(GridShare, StretchesMakeUpTheWholeGrid) {
  const Communicator& world = Communicator::world();
  FieldGrid whole = two_layers(), mine = two_layers();
  const std::vector<Middle> middles = separate_middles<2>(whole);
  ASSERT_EQ(whole.points.size(), 12u);
  EXPECT_EQ(whole.points[11], whole.points[6]);
  const GridShare share = share_out<2>(mine, part_of(two_layers(), world));

  ASSERT_TRUE(mine.stretch);
  EXPECT_EQ(point_count(mine), whole.points.size());
  EXPECT_EQ(cell_count(mine), 2u);
  EXPECT_TRUE(is_layered(mine));
  EXPECT_EQ(world.sum_before(static_cast<std::int64_t>(mine.points.size())),
            static_cast<std::int64_t>(mine.stretch->first_point));
  EXPECT_EQ(world.sum_before(static_cast<std::int64_t>(cells_here(mine))),
            static_cast<std::int64_t>(mine.stretch->first_cell));
  std::vector<double> points, all;
  for (const Point& point : mine.points) points.insert(points.end(), point.begin(), point.end());
  for (const Point& point : whole.points) all.insert(all.end(), point.begin(), point.end());
  EXPECT_EQ(world.gather(points), all);
  EXPECT_EQ(world.gather(mine.cells), whole.cells);
  EXPECT_EQ(world.gather(mine.layer), whole.layer);

  const auto values = field(share.order.items(), share.middles);
  EXPECT_EQ(world.gather(share.order.to_stretches(values.data(), 1)), field(whole.points.size(), middles));
}

}  // namespace

}  // namespace fsi::test
