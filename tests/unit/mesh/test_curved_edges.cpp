// Quadratic arteries: their edges follow the cylinders and no cell is folded.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/curved_cells.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesher/artery/curved_edges.hpp"
#include "mesher/artery_generator.hpp"

namespace fsi {
namespace {

CellJacobian jacobian(const SimplexMesh<3, 2>& mesh, const SimplexMesh<3, 2>::Cell& cell) {
  std::array<Point, 10> x;
  for (int a = 0; a < 10; ++a) x[a] = mesh.nodes[cell[a]];
  return cell_jacobian<3>(x);
}

double volume(const SimplexMesh<3, 2>& mesh, int region) {
  double sum = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (mesh.cell_region[c] == region) sum += jacobian(mesh, mesh.cells[c]).mean / 6;
  return sum;
}

ArteryShape tube_shape() {
  ArteryShape shape;
  shape.length = 3;
  return shape;
}

struct Tube {
  const char* name;
  TetrahedralMesh (*make)();
  double least_ratio;  ///< of det J, least to mean in a cell; measured once, rounded down
};

void PrintTo(const Tube& tube, std::ostream* out) {
  *out << tube.name;
}

TetrahedralMesh level(const char* name) {
  auto options = artery_level(name);
  options.length = 3;
  return generate_artery(options);
}

TetrahedralMesh tube(int lumen, int media, int around, int axial, double grading, int degrees) {
  ArteryCells cells;
  cells.lumen = lumen;
  cells.media = cells.adventitia = media;
  cells.around = around;
  cells.axial = axial;
  cells.lumen_grading = cells.axial_grading = grading;
  return generate_artery(tube_shape(), cells, degrees);
}

class CurvedEdges : public testing::TestWithParam<Tube> {};

TEST_P(CurvedEdges, NodesOfEdgesOnACylinderAreOnIt) {
  const auto linear = GetParam().make();
  const auto mesh = with_curved_edges(linear, 1.43);
  int found = 0;
  for (const auto& cell : mesh.cells)
    for (int e = 0; e < 6; ++e) {
      const auto& [a, b] = SimplexEdges<3>::vertices[e];
      const auto radius = [&](int node) { return std::hypot(mesh.nodes[node][0], mesh.nodes[node][1]); };
      const double ra = radius(cell[a]);
      if (std::abs(ra - radius(cell[b])) > 1e-12 || ra < 1.4299999) continue;
      EXPECT_NEAR(radius(cell[4 + e]), ra, 1e-12);
      ++found;
    }
  EXPECT_GT(found, 100);
  EXPECT_TRUE(std::equal(linear.nodes.begin(), linear.nodes.end(), mesh.nodes.begin()));
}

TEST_P(CurvedEdges, NodesOfInterfacesAndOuterFaceAreOnTheirCylinders) {
  const auto mesh = with_curved_edges(GetParam().make(), 1.43);
  const auto on = [&](const std::vector<int>& nodes, double radius) {
    EXPECT_GT(nodes.size(), 10u);
    for (const int node : nodes) EXPECT_NEAR(std::hypot(mesh.nodes[node][0], mesh.nodes[node][1]), radius, 1e-12);
  };
  on(facet_nodes(interface_facets(mesh, 0, {1, 2})), 1.43);
  on(facet_nodes(interface_facets(mesh, 1, {2})), 1.69);
  on(facet_nodes(*mesh.facets("outer")), 1.82);
}

TEST_P(CurvedEdges, JacobiansArePositiveAndVaryLittle) {
  const auto mesh = with_curved_edges(GetParam().make(), 1.43);
  double least = 1;
  for (const auto& cell : mesh.cells) {
    const auto j = jacobian(mesh, cell);
    ASSERT_TRUE(j.positive);
    least = std::min(least, j.ratio());
  }
  EXPECT_GT(least, GetParam().least_ratio);
}

TEST_P(CurvedEdges, PlanesOfSymmetryStayPlane) {
  const auto mesh = with_curved_edges(GetParam().make(), 1.43);
  for (const int axis : {0, 1}) {
    const auto* plane = mesh.facets(axis == 0 ? "symmetry_x" : "symmetry_y");
    if (plane == nullptr) continue;
    for (const int node : facet_nodes(*plane)) EXPECT_EQ(mesh.nodes[node][axis], 0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, CurvedEdges,
                         testing::Values(Tube{"coarse", [] { return level("coarse"); }, 0.7},
                                         Tube{"intermediate", [] { return level("intermediate"); }, 0.8},
                                         Tube{"graded", [] { return tube(4, 2, 12, 10, 3, 360); }, 0.7},
                                         Tube{"quarter", [] { return tube(4, 2, 12, 10, 3, 90); }, 0.7},
                                         Tube{"half", [] { return tube(4, 1, 16, 6, 2, 180); }, 0.7},
                                         Tube{"fewest", [] { return tube(1, 1, 6, 2, 1, 360); },
                                              0.7},  // 60 degrees a cell
                                         Tube{"thin_layers", [] { return tube(8, 5, 8, 4, 20, 90); }, 0.7}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(CurvedEdgesOrder, VolumesConvergeWithTheFourthPowerOfTheFacets) {
  const double circles[] = {1.43 * 1.43, 1.69 * 1.69 - 1.43 * 1.43, 1.82 * 1.82 - 1.69 * 1.69};
  const auto errors = [&](int around) {
    const auto mesh = with_curved_edges(tube(3, 1, around, 2, 1, 90), 1.43);
    std::array<double, 3> missing;
    for (int r = 0; r < 3; ++r) missing[r] = std::abs(volume(mesh, r) - M_PI / 4 * 3 * circles[r]);
    return missing;
  };
  const auto coarse = errors(16), fine = errors(32);
  for (int r = 0; r < 3; ++r) EXPECT_NEAR(std::log2(coarse[r] / fine[r]), 4, 0.1) << r;
  // Straight edges leave 2.6 % of the area at sixteen.
  EXPECT_LT(coarse[0], 1e-4 * M_PI / 4 * 3 * circles[0]);
}

TEST(CurvedEdgesOrder, EdgesInsideTheLumenBecomeStraightBySquareOfRadius) {
  const auto linear = tube(4, 1, 12, 2, 1, 360);
  const auto curved = with_curved_edges(linear, 1.43);
  const auto straight = with_mid_edge_nodes(linear);
  // On the ring half way: the arc's height above the chord, a quarter of it.
  double found = 0;
  for (std::size_t n = linear.nodes.size(); n < curved.nodes.size(); ++n) {
    const double chord = std::hypot(straight.nodes[n][0], straight.nodes[n][1]);
    if (std::abs(chord - 0.715 * std::cos(M_PI / 12)) > 1e-12) continue;
    found = std::hypot(curved.nodes[n][0], curved.nodes[n][1]) - chord;
    EXPECT_NEAR(found, 0.25 * 0.715 * (1 - std::cos(M_PI / 12)), 1e-14);
  }
  EXPECT_GT(found, 0);
}

TEST(CurvedEdgesOrder, RefusesFoldedCells) {
  // Six cells in the first ring, twenty-four in the second, a thousandth of the radius apart.
  const auto linear = tube(2, 1, 24, 2, 1000, 360);
  try {
    with_curved_edges(linear, 1.43);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("fsi-mesh: --order: a tetrahedron is folded by its curved edges"), 0u)
        << error.what();
  }
}

}  // namespace
}  // namespace fsi
