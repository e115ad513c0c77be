// What the gmsh library makes of the files that are written with it, for every kind of mesh.
#include <gmsh.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "mesh_io/gmsh_writer.hpp"
#include "mesher/artery/curved_edges.hpp"
#include "mesher/artery_generator.hpp"

namespace fsi {
namespace {

ArteryShape stub_shape() {
  ArteryShape shape;
  shape.length = 2;
  return shape;
}
ArteryCells few_cells() {
  ArteryCells cells;
  cells.lumen = 2;
  cells.axial = 3;
  return cells;
}

/// Measure of all cells of a type by gmsh's own shape functions and quadrature, and the smallest det J that it met.
struct Measured {
  double sum = 0, least = 1e9;
};
Measured measured_by_gmsh(int type) {
  std::vector<double> points, weights, jacobians, determinants, coordinates;
  gmsh::model::mesh::getIntegrationPoints(type, "Gauss4", points, weights);
  gmsh::model::mesh::getJacobians(type, points, jacobians, determinants, coordinates);
  Measured result;
  for (std::size_t i = 0; i < determinants.size(); ++i) {
    result.sum += weights[i % weights.size()] * determinants[i];
    result.least = std::min(result.least, determinants[i]);
  }
  return result;
}

class GmshWriter : public testing::Test {
 protected:
  void SetUp() override {
    file_ = std::filesystem::path(testing::TempDir()) / ("gmsh_writer_" + std::to_string(getpid()) + ".msh");
  }
  void TearDown() override { std::filesystem::remove(file_); }

  /// Writes the mesh in all formats; gmsh must find its nodes, elements of these types, groups, and this measure.
  template <int Dim, int Order>
  void expect_understood(const SimplexMesh<Dim, Order>& mesh, int cell_type, int facet_type, double measure,
                         double tolerance) {
    for (const auto& format :
         {GmshFormat{"4.1", false}, GmshFormat{"4.1", true}, GmshFormat{"2.2", false}, GmshFormat{"2.2", true}}) {
      SCOPED_TRACE(format.version + (format.binary ? " binary" : " ASCII"));
      write_gmsh(mesh, file_, format);
      gmsh::initialize(0, nullptr, false);
      gmsh::option::setNumber("General.Terminal", 0);
      gmsh::open(file_.string());
      expect_in_model(mesh, cell_type, facet_type, measure, tolerance);
      gmsh::finalize();
    }
  }

 private:
  template <int Dim, int Order>
  void expect_in_model(const SimplexMesh<Dim, Order>& mesh, int cell_type, int facet_type, double measure,
                       double tolerance) {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parametric;
    gmsh::model::mesh::getNodes(tags, coordinates, parametric);
    ASSERT_EQ(tags.size(), mesh.nodes.size());
    for (std::size_t i = 0; i < tags.size(); ++i)
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(coordinates[3 * i + k], mesh.nodes[tags[i] - 1][k], 1e-15);

    std::size_t facets = 0;
    for (const auto& group : mesh.facet_groups) facets += group.facets.size();
    const auto elements = [](int type) {
      std::vector<std::size_t> found, ends;
      gmsh::model::mesh::getElementsByType(type, found, ends);
      return found.size();
    };
    EXPECT_EQ(elements(facet_type), facets);
    EXPECT_EQ(elements(cell_type), mesh.cells.size());
    const auto found = measured_by_gmsh(cell_type);
    EXPECT_NEAR(found.sum, measure, tolerance);
    EXPECT_GT(found.least, 0);

    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups);
    EXPECT_EQ(groups.size(), mesh.regions.size() + mesh.facet_groups.size());
    std::vector<std::string> regions, surfaces;
    for (const auto& [dimension, tag] : groups) {
      std::string name;
      gmsh::model::getPhysicalName(dimension, tag, name);
      (dimension == Dim ? regions : surfaces).push_back(name);
    }
    EXPECT_EQ(regions, mesh.regions);
    ASSERT_EQ(surfaces.size(), mesh.facet_groups.size());
    for (std::size_t g = 0; g < surfaces.size(); ++g) EXPECT_EQ(surfaces[g], mesh.facet_groups[g].name);
  }

  std::filesystem::path file_;
};

constexpr double outer_radius = 1.82, length = 2;
// Tolerances: gmsh tabulates the weights of tetrahedra to twelve digits.

TEST_F(GmshWriter, LinearTetrahedra) {
  const double polygon = 6 * std::sin(2 * M_PI / 12) * outer_radius * outer_radius;
  expect_understood(generate_artery(stub_shape(), few_cells()), 4, 2, polygon * length, 1e-9);
}

TEST_F(GmshWriter, QuadraticTetrahedra) {
  const auto linear = generate_artery(stub_shape(), few_cells());
  const double polygon = 6 * std::sin(2 * M_PI / 12) * outer_radius * outer_radius;
  expect_understood(with_mid_edge_nodes(linear), 11, 9, polygon * length, 1e-9);
  // Area between a chord and the parabola to the arc's middle: 2/3 of width times height, twelve times.
  const double width = 2 * outer_radius * std::sin(M_PI / 12), height = outer_radius * (1 - std::cos(M_PI / 12));
  expect_understood(with_curved_edges(linear, 1.43), 11, 9, (polygon + 12 * 2.0 / 3 * width * height) * length, 1e-9);
}

TEST_F(GmshWriter, LinearTriangles) {
  expect_understood(generate_artery_section(stub_shape(), few_cells()), 2, 1, outer_radius * length, 1e-13);
}

TEST_F(GmshWriter, QuadraticTriangles) {
  expect_understood(with_mid_edge_nodes(generate_artery_section(stub_shape(), few_cells())), 9, 8,
                    outer_radius * length, 1e-13);
}

}  // namespace
}  // namespace fsi
