#include <gtest/gtest.h>

#include <cmath>

#include "fem/gather_blocks.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "scene/build_scene.hpp"
#include "support/meshes.hpp"
#include "support/nodal_arrays.hpp"
#include "support/problems.hpp"
#include "support/random.hpp"
#include "wall/wall_assembly.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;

/// Everything the element loops make of one state.
struct Assembled {
  std::vector<double> fluid, fluid_flow, fluid_mesh, wall, wall_matrix, mesh_matrix, mesh_product;
};

Assembled assemble_with(int thread_count) {
  set_threads(thread_count);
  const auto mesh = irregular_cube(3);
  const auto& x = mesh.nodes;
  Assembled all;
  FluidProblem<Tet> fluid(whole(mesh), {1.3, 0.03, true, 0.5}, {});
  EXPECT_EQ(fluid.packs().thread_count(), thread_count);
  const auto d = random_field(x, 3, 0.1, 0.02, 1), d_old = random_field(x, 3, 0.1, 0.02, 2);
  const auto u = random_field(x, 4, 3, 0.5, 3), u_old = random_field(x, 4, 3, 0.5, 4);
  FluidJacobian<3> jacobian(fluid.graph(), FluidDerivatives::fluid_and_domain);
  fluid.assemble(euler_input(&d, &d_old, u, u_old, 0.5), {}, all.fluid, &jacobian);
  all.fluid_flow = jacobian.fluid.values;
  all.fluid_mesh = jacobian.shape_derivatives.values;

  const CylinderAxis axis{{{-0.7, -0.4, 0}}, {{0, 0, 1}}};
  WallProblem<Tet> wall(whole(mesh), {1.2, 50, 0.5}, {{0, Artery{3, 2.4, 0.8, 1, 29}}}, axis);
  const auto s = random_field(x, 4, 0.1, 0.02, 5), history = random_field(x, 3, 1, 0.1, 6);
  WallMatrix<3> wall_jacobian(wall.graph());
  wall.assemble({s.data(), history.data(), 16.0}, 0, s, all.wall, &wall_jacobian);
  all.wall_matrix = wall_jacobian.values;

  MeshMotionMatrix<3> matrix(fluid.graph());
  assemble_mesh_motion(fluid.packs(), matrix);
  all.mesh_matrix = matrix.values;
  all.mesh_product.resize(d.size());
  multiply_mesh_motion<3>(matrix, d, all.mesh_product);
  return all;
}

// Rows, not elements, are owned by threads, and every entry is summed in the order of the elements: equal bit for bit.
TEST(ElementPacks, ResultsDoNotDependOnTheNumberOfThreads) {
  const auto one = assemble_with(1);
  EXPECT_GT(norm(one.fluid), 0);
  for (const int count : {2, 3, 5}) {
    const auto several = assemble_with(count);
    EXPECT_EQ(one.fluid, several.fluid) << count;
    EXPECT_EQ(one.fluid_flow, several.fluid_flow) << count;
    EXPECT_EQ(one.fluid_mesh, several.fluid_mesh) << count;
    EXPECT_EQ(one.wall, several.wall) << count;
    EXPECT_EQ(one.wall_matrix, several.wall_matrix) << count;
    EXPECT_EQ(one.mesh_matrix, several.mesh_matrix) << count;
    EXPECT_EQ(one.mesh_product, several.mesh_product) << count;
  }
  set_threads(1);
}

TEST(ElementPacks, EveryRowIsOwnedOnceAlsoByMoreThreadsThanNodes) {
  for (const int count : {1, 3, 7}) {
    set_threads(count);
    const std::vector<Point> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto graph = graph_of_cells(4, {0, 1, 2, 3}, 4);
    const ElementPacks<Tet> packs(x, std::vector<std::array<int, 4>>{{0, 1, 2, 3}}, {0}, graph);
    std::vector<int> owners(graph.blocks(), 0);
    for (int t = 0; t < packs.thread_count(); ++t)
      for (const auto& pack : packs.of_thread(t))
        for (const auto& lanes : pack.position)
          for (int position : lanes)
            if (position >= 0) ++owners[position];
    EXPECT_EQ(owners, std::vector<int>(graph.blocks(), 1)) << count;
  }
  set_threads(1);
}

// The cells of a mesh one at a time, each in a pack that is empty but for one lane, add up to the mesh at once.
TEST(ElementPacks, EmptyLanesAddNothing) {
  set_threads(1);
  const auto mesh = irregular_cube(2);
  const auto part = whole(mesh);
  std::vector<int> cell_nodes;
  for (const auto& cell : mesh.cells) cell_nodes.insert(cell_nodes.end(), cell.begin(), cell.end());
  const auto graph = std::make_shared<const NodeGraph>(graph_of_cells(part.node_count(), cell_nodes, 4));
  const auto solution = random_field(mesh.nodes, 4, 0.1, 0.02, 5);
  const auto assemble = [&](const std::vector<int>& cells, WallMatrix<3>& matrix) {
    std::vector<WallLayer<Tet>> layers;
    layers.push_back({ElementPacks<Tet>(mesh.nodes, mesh.cells, cells, *graph), NeoHookean{3}, {}});
    EXPECT_EQ(layers[0].packs.element_count(), cells.size());
    std::vector<double> residual(4 * mesh.nodes.size(), 0.0);
    assemble_wall<Tet>({1.2, 50, 0.5}, layers, {solution.data(), nullptr, 0}, residual, &matrix);
    return residual;
  };
  std::vector<int> all(mesh.cells.size());
  std::vector<double> sum(4 * mesh.nodes.size(), 0.0);
  WallMatrix<3> whole_matrix(graph), matrix(graph), matrix_sum(graph);
  for (std::size_t c = 0; c < all.size(); ++c) {
    all[c] = static_cast<int>(c);
    sum = moved(sum, 1, assemble({all[c]}, matrix));
    matrix_sum.values = moved(matrix_sum.values, 1, matrix.values);
  }
  const auto at_once = assemble(all, whole_matrix);
  EXPECT_LT(largest(difference(at_once, sum)), 1e-15 * 10);
  EXPECT_LT(largest(difference(whole_matrix.values, matrix_sum.values)), 1e-13);
}

TEST(AssemblyResult, TellsTheWorstElementAndSeesInversionAndNaN) {
  set_threads(1);
  const auto mesh = irregular_cube(2);
  FluidProblem<Tet> fluid(whole(mesh), {1, 0.1, false, 0.1}, {});
  std::vector<double> d(3 * mesh.nodes.size(), 0.0), u(4 * mesh.nodes.size(), 0.0), r;
  const auto result_of = [&] { return fluid.assemble(euler_input(&d, &d, u, u, 0.1), {}, r); };
  EXPECT_FALSE(result_of().inverted());
  EXPECT_EQ(result_of().smallest_volume_ratio, 1);

  // The inner node of the 2 x 2 x 2 cube moves almost to a corner, then beyond the opposite face.
  const int inner = 13;
  d[3 * inner] = 0.35;
  const auto squeezed = result_of();
  EXPECT_FALSE(squeezed.inverted());
  EXPECT_GT(squeezed.smallest_volume_ratio, 0);
  EXPECT_LT(squeezed.smallest_volume_ratio, 0.5);
  const auto& cell = mesh.cells[squeezed.cell];
  EXPECT_TRUE(std::find(cell.begin(), cell.end(), inner) != cell.end());

  d[3 * inner] = 0.8;
  EXPECT_TRUE(result_of().inverted());
  d[3 * inner] = NAN;
  EXPECT_TRUE(result_of().inverted());
}

TEST(FacetIntegrals, FlowAndMeanPressureOfOpenFaces) {
  const auto mesh = irregular_cube(3);
  const auto inlet = facets_where(mesh, "fluid", [](const Point& x) { return x[0] == 0; });
  const auto outlet = facets_where(mesh, "fluid", [](const Point& x) { return x[0] == 1; });
  const FluidProblem<Tet> fluid(
      whole(mesh), {1, 0.1, false, 0.1},
      {open_boundary<Tet>("inlet", mesh.nodes, inlet), open_boundary<Tet>("outlet", mesh.nodes, outlet)});
  std::vector<double> flow;
  for (const auto& x : mesh.nodes)
    for (double value : {2 + x[1] + x[0], 5.0, -3.0, 1 + x[1] + 2 * x[2] + 4 * x[0]}) flow.push_back(value);
  const auto &in = *fluid.open_boundary("inlet"), &out = *fluid.open_boundary("outlet");
  EXPECT_NEAR(in.outflow(flow), -2.5, 1e-14) << "outwards positive; mean of 2 + y over the unit square";
  EXPECT_NEAR(out.outflow(flow), 3.5, 1e-14);
  EXPECT_NEAR(in.mean_pressure(flow), 1 + 0.5 + 1, 1e-14);
  EXPECT_NEAR(out.mean_pressure(flow), 5 + 0.5 + 1, 1e-14);
  EXPECT_EQ(fluid.open_boundary("side"), nullptr);
}

TEST(FacetIntegrals, InletTractionPushesInwards) {
  const auto mesh = irregular_cube(3);
  const auto inlet = facets_where(mesh, "fluid", [](const Point& x) { return x[0] == 0; });
  FluidProblem<Tet> fluid(whole(mesh), {1, 0.1, false, 0.1}, {open_boundary<Tet>("inlet", mesh.nodes, inlet)});
  const std::vector<double> rest(4 * mesh.nodes.size(), 0.0);
  std::vector<double> r;
  fluid.assemble(euler_input(nullptr, nullptr, rest, rest, 0.1), {3.0}, r);
  double force[3] = {};
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    for (int i = 0; i < 3; ++i) force[i] -= r[4 * a + i];  // force = - residual
  EXPECT_NEAR(force[0], 3, 1e-14) << "3 kPa on 1 mm^2 along +x, into the fluid";
  EXPECT_NEAR(force[1], 0, 1e-15);
  EXPECT_NEAR(force[2], 0, 1e-15);
}

// Two nodes coupled by one block of 2 x 2: unknown 1 serves two entries with different factors, one entry is
// prescribed.
TEST(GatherBlocks, WeighsByTheFactorsOfRowAndColumn) {
  const auto graph = std::make_shared<NodeGraph>(graph_of_cells(2, {0, 1}, 2));
  BlockMatrix<2, 2> blocks(graph);
  for (std::size_t i = 0; i < blocks.values.size(); ++i) blocks.values[i] = static_cast<double>(i + 1);
  // Entries: node 0 -> unknowns 0 and 1, node 1 -> prescribed and again 1, as u and d_s on the interface.
  const UnknownMap rows{{0, 1}, {1, 1}, {-1, 1}, {1, 1}}, columns{{0, 1}, {1, 1}, {-1, 1}, {1, 10}};
  GatheredMatrix::Builder builder(2);
  gather_blocks(builder, blocks, rows, columns);
  GatheredMatrix gathered(std::move(builder));
  gathered.update();
  // Blocks, row-major: (0,0) = 1 2 / 3 4, (0,1) = 5 6 / 7 8, (1,0) = 9 10 / 11 12, (1,1) = 13 14 / 15 16.
  const auto e0 = product(gathered.matrix(), {1, 0}), e1 = product(gathered.matrix(), {0, 1});
  EXPECT_EQ(e0, (std::vector<double>{1, 3 + 11}));
  EXPECT_EQ(e1, (std::vector<double>{2 + 10 * 6, 4 + 10 * 8 + 12 + 10 * 16}));

  std::vector<double> field(4, 0.0), system(2, 0.0);
  add_to_field(columns, {2, 3}, 0.5, field);
  EXPECT_EQ(field, (std::vector<double>{1, 1.5, 0, 15}));
  add_to_system(rows, {1, 2, 4, 8}, system);
  EXPECT_EQ(system, (std::vector<double>{1, 10}));
}

TEST(FibreDirections, LieInTheCylindersTangentPlaneAtTheGivenAngle) {
  set_threads(1);
  const auto mesh = irregular_cube(2);
  const auto part = whole(mesh);
  std::vector<int> cell_nodes, all;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    cell_nodes.insert(cell_nodes.end(), mesh.cells[c].begin(), mesh.cells[c].end());
    all.push_back(static_cast<int>(c));
  }
  const ElementPacks<Tet> packs(mesh.nodes, mesh.cells, all, graph_of_cells(part.node_count(), cell_nodes, 4));
  const double angle = 0.5, s = 1 / std::sqrt(3.0);
  const CylinderAxis axis{{{-1, 2, 0.5}}, {{s, s, s}}};
  const auto fibres = fibre_directions(packs, mesh.nodes, mesh.cells, axis, angle);
  ASSERT_EQ(fibres[0].size(), packs.of_thread(0).size());
  for (std::size_t p = 0; p < fibres[0].size(); ++p)
    for (int index = 0; index < pack_width * Tet::points; ++index) {
      const int q = index / pack_width, at = index % pack_width;
      Vec3<double> offset{{1, -2, -0.5}}, a[2];
      const auto& cell = mesh.cells[packs.of_thread(0)[p].cell[at]];
      for (int node = 0; node < 4; ++node)
        for (int i = 0; i < 3; ++i) offset[i] += Tet::shape(q, node) * mesh.nodes[cell[node]][i];
      for (int family = 0; family < 2; ++family)
        for (int i = 0; i < 3; ++i) a[family][i] = fibres[0][p][q].direction[family][i][at];
      const double along = dot(offset, axis.direction);
      const auto radial = offset - along * axis.direction;
      const auto hoop = cross(axis.direction, radial);
      const double radius = std::sqrt(dot(radial, radial));
      for (int family = 0; family < 2; ++family) {
        EXPECT_NEAR(dot(a[family], a[family]), 1, 1e-14);
        EXPECT_NEAR(dot(a[family], radial), 0, 1e-14);
        EXPECT_NEAR(dot(a[family], hoop) / radius, std::cos(angle), 1e-14);
        EXPECT_NEAR(dot(a[family], axis.direction), (family == 0 ? 1 : -1) * std::sin(angle), 1e-14);
      }
    }
}

}  // namespace

}  // namespace fsi::test
