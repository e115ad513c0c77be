// Files of first and second order, in two and three dimensions, written by the gmsh library itself.

#include <gmsh.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "mesh/quality.hpp"
#include "mesh_io/gmsh_reader.hpp"

// What the gmsh library itself loses when it writes curved or physical entities is not ours to free.
extern "C" const char* __lsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libgmsh";
}

namespace fsi {
namespace {

struct FileKind {
  double version;
  bool binary;
};
constexpr FileKind kinds[] = {{4.1, false}, {4.1, true}, {2.2, false}, {2.2, true}};

class GmshOrders : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("gmsh_orders_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// A quarter of the unit disk in the plane z = 0, or of a cylinder of length 1 above it: fluid where x^2 + y^2 < 1,
  /// its curved side in the group `outer`, flat ones in `symmetry_x` and `symmetry_y`.
  std::filesystem::path quarter(int dimension, int order, const FileKind& kind) const {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    const auto point = [](double x, double y) { return gmsh::model::geo::addPoint(x, y, 0, 0.5); };
    const int centre = point(0, 0), right = point(1, 0), top = point(0, 1);
    const int bottom_line = gmsh::model::geo::addLine(centre, right);
    const int arc = gmsh::model::geo::addCircleArc(right, centre, top);
    const int left_line = gmsh::model::geo::addLine(top, centre);
    const int face = gmsh::model::geo::addPlaneSurface({gmsh::model::geo::addCurveLoop({bottom_line, arc, left_line})});
    const auto group = [](int dim, int entity, const char* name) {
      const int tag = gmsh::model::addPhysicalGroup(dim, {entity});
      gmsh::model::setPhysicalName(dim, tag, name);
    };
    gmsh::vectorpair out;
    if (dimension == 3) gmsh::model::geo::extrude({{2, face}}, 0, 0, 1, out, {2});
    gmsh::model::geo::synchronize();
    if (dimension == 3) {
      group(3, out[1].second, "fluid");
      group(2, face, "inlet");
      group(2, out[0].second, "outlet");
      group(2, out[2].second, "symmetry_y");
      group(2, out[3].second, "outer");
      group(2, out[4].second, "symmetry_x");
    } else {
      group(2, face, "fluid");
      group(1, bottom_line, "symmetry_y");
      group(1, arc, "outer");
      group(1, left_line, "symmetry_x");
    }
    gmsh::model::mesh::generate(dimension);
    gmsh::model::mesh::setOrder(order);
    return write(kind);
  }

  /// A rectangle 0 < r < 2, 0 < along < 3 drawn in the plane z = 0, or turned into the plane y = 0, moved by `shift`.
  std::filesystem::path rectangle(int order, bool meridian, const Point& shift = {0, 0, 0}) const {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    const auto point = [&](double r, double along) {
      return meridian ? gmsh::model::geo::addPoint(r + shift[0], shift[1], along + shift[2], 0.7)
                      : gmsh::model::geo::addPoint(r + shift[0], along + shift[1], shift[2], 0.7);
    };
    const int a = point(0, 0), b = point(2, 0), c = point(2, 3), d = point(0, 3);
    const int start = gmsh::model::geo::addLine(a, b), side = gmsh::model::geo::addLine(b, c),
              end = gmsh::model::geo::addLine(c, d), axis = gmsh::model::geo::addLine(d, a);
    const int face = gmsh::model::geo::addPlaneSurface({gmsh::model::geo::addCurveLoop({start, side, end, axis})});
    gmsh::model::geo::synchronize();
    const auto group = [](int dim, int entity, const char* name) {
      gmsh::model::setPhysicalName(dim, gmsh::model::addPhysicalGroup(dim, {entity}), name);
    };
    group(2, face, "fluid");
    group(1, start, "inlet");
    group(1, end, "outlet");
    gmsh::model::mesh::generate(2);
    gmsh::model::mesh::setOrder(order);
    return write({4.1, false});
  }

  std::filesystem::path text(const std::string& content) const {
    std::ofstream(folder_ / "text.msh") << content;
    return folder_ / "text.msh";
  }

  std::filesystem::path write(const FileKind& kind) const {
    const auto file = folder_ / "mesh.msh";
    gmsh::option::setNumber("Mesh.MshFileVersion", kind.version);
    gmsh::option::setNumber("Mesh.Binary", kind.binary ? 1 : 0);
    gmsh::write(file.string());
    gmsh::finalize();
    return file;
  }

  std::filesystem::path folder_;
};

/// Every mid-edge node stands by the middle of its own edge, much nearer than to that of any other of the cell.
template <int Dim>
void expect_nodes_on_their_edges(const SimplexMesh<Dim, 2>& mesh) {
  for (const auto& cell : mesh.cells)
    for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
      const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
      const Point &x = mesh.nodes[cell[a]], &y = mesh.nodes[cell[b]];
      EXPECT_LT(distance(mesh.nodes[cell[Dim + 1 + e]], 0.5 * (x + y)), 0.1 * distance(x, y));
    }
}

template <int Dim, int Order>
void expect_same(const SimplexMesh<Dim, Order>& a, const SimplexMesh<Dim, Order>& b) {
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.cell_region, b.cell_region);
  ASSERT_EQ(a.facet_groups.size(), b.facet_groups.size());
  for (std::size_t g = 0; g < a.facet_groups.size(); ++g) EXPECT_EQ(a.facet_groups[g].facets, b.facet_groups[g].facets);
}

template <class Read>
std::string message_of(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find(".msh: ") + 6);
  }
  return "accepted";
}

TEST_F(GmshOrders, QuadraticTetrahedraInAllFormats) {
  for (const auto& kind : kinds) {
    SCOPED_TRACE(kind.version * 10 + kind.binary);
    const auto file = quarter(3, 2, kind);
    const auto mesh = read_gmsh<3, 2>(file, {"fluid"});
    expect_nodes_on_their_edges(mesh);
    for (const int node : facet_nodes(*mesh.facets("outer")))
      EXPECT_NEAR(std::hypot(mesh.nodes[node][0], mesh.nodes[node][1]), 1, 1e-12);
    const auto quality = measure_quality(mesh);
    EXPECT_NEAR(quality.regions[0].volume, M_PI / 4, 2e-4);
    EXPECT_GT(quality.min_jacobian, 0.3);
    EXPECT_LT(quality.min_jacobian, 0.99);
    SceneMeshNeeds needs;
    needs.fluid = needs.inlet = needs.outlet = true;
    EXPECT_NO_THROW(check_scene_mesh(mesh, needs, "quarter"));
    expect_same(read_gmsh<3, 1>(file, {"fluid"}), without_mid_edge_nodes(mesh));
  }
}

TEST_F(GmshOrders, QuadraticTrianglesInAllFormats) {
  for (const auto& kind : kinds) {
    SCOPED_TRACE(kind.version * 10 + kind.binary);
    const auto file = quarter(2, 2, kind);
    EXPECT_EQ(gmsh_dimension(file), 2);
    EXPECT_EQ(gmsh_regions(file, 2), std::vector<std::string>{"fluid"});
    const auto mesh = read_gmsh<2, 2>(file, {"fluid"}, TriangleGeometry::plane);
    expect_nodes_on_their_edges(mesh);
    const auto& arc = *mesh.facets("outer");
    for (const int node : facet_nodes(arc)) EXPECT_NEAR(norm(mesh.nodes[node]), 1, 1e-12);
    for (const auto& edge : arc)  // the outside lies to the right of an edge
      EXPECT_LT(planar_cross(mesh.nodes[edge[1]] - mesh.nodes[edge[0]], mesh.nodes[edge[2]]), 0);
    EXPECT_EQ(rim_nodes<2>(arc).size(), 2u);
    EXPECT_NEAR(measure_quality(mesh).regions[0].volume, M_PI / 4, 2e-4);
    expect_same(read_gmsh<2, 1>(file, {"fluid"}, TriangleGeometry::plane), without_mid_edge_nodes(mesh));
  }
}

TEST_F(GmshOrders, LinearFilesGetStraightEdges) {
  for (const auto& kind : kinds) {
    const auto solid = quarter(3, 1, kind);
    expect_same(read_gmsh<3, 2>(solid, {"fluid"}), with_mid_edge_nodes(read_gmsh<3, 1>(solid, {"fluid"})));
    const auto flat = quarter(2, 1, kind);
    expect_same(read_gmsh<2, 2>(flat, {"fluid"}, TriangleGeometry::plane),
                with_mid_edge_nodes(read_gmsh<2, 1>(flat, {"fluid"}, TriangleGeometry::plane)));
  }
}

TEST_F(GmshOrders, AxisymmetricMeshesFromBothPlanes) {
  for (const bool meridian : {false, true}) {
    const auto mesh = read_gmsh<2, 2>(rectangle(2, meridian, {-1e-12, 0, 0}), {"fluid"});
    int on_axis = 0;
    for (const auto& x : mesh.nodes) {
      EXPECT_EQ(x[1], 0);
      EXPECT_GE(x[0], 0);
      on_axis += x[0] == 0;
    }
    EXPECT_GE(on_axis, 9);  // five vertices at least and the middles between
    for (const int node : facet_nodes(*mesh.facets("inlet"))) EXPECT_NEAR(mesh.nodes[node][2], 0, 1e-12);
    for (const int node : facet_nodes(*mesh.facets("outlet"))) EXPECT_NEAR(mesh.nodes[node][2], 3, 1e-12);
    for (const auto& cell : mesh.cells)
      EXPECT_GT(triangle_area(mesh.nodes[cell[0]], mesh.nodes[cell[1]], mesh.nodes[cell[2]]), 0);
    expect_nodes_on_their_edges(mesh);
    EXPECT_NEAR(measure_quality(mesh).regions[0].volume, 6, 1e-9);
    SceneMeshNeeds needs;
    needs.fluid = needs.inlet = needs.outlet = true;
    EXPECT_NO_THROW(check_scene_mesh(mesh, needs, "rectangle"));
  }
}

TEST_F(GmshOrders, RefusesTrianglesOutOfPlaceAndOtherDimensions) {
  const auto read = [&](const std::filesystem::path& file, TriangleGeometry geometry) {
    return message_of([&] { read_gmsh<2, 1>(file, {"fluid"}, geometry); });
  };
  EXPECT_EQ(read(rectangle(1, false, {0, 0, 0.5}), TriangleGeometry::plane),
            "node 1: (0, 0, 0.5) is out of the plane of the mesh; a plane mesh lies in the plane z = 0");
  EXPECT_EQ(
      read(rectangle(1, true, {0, 0.5, 0}), TriangleGeometry::axisymmetric),
      "node 1: (0, 0.5, 0) is out of the plane of the mesh; an axisymmetric mesh lies in the plane y = 0 (r along "
      "x, axis along z) or in the plane z = 0 (r along x, axis along y)");
  EXPECT_EQ(read(rectangle(1, false, {-0.5, 0, 0}), TriangleGeometry::axisymmetric),
            "node 1: its radius is negative, r = x = -0.5 mm; draw the half of the section with x >= 0; or choose "
            "geometry = \"plane\"");
  EXPECT_EQ(read(rectangle(1, false, {-0.5, 0, 0}), TriangleGeometry::plane), "accepted");
  EXPECT_EQ(
      read(quarter(3, 1, kinds[0]), TriangleGeometry::plane),
      "geometry: this mesh is three-dimensional: it names physical volumes; choose geometry = \"3d\", or a mesh of "
      "physical surfaces");
  EXPECT_EQ(message_of([&] { read_gmsh<3, 2>(quarter(2, 2, kinds[0]), {"fluid"}); }),
            "geometry: this mesh is two-dimensional: it names physical surfaces and has no volumes; choose geometry = "
            "\"axisymmetric\" or \"plane\", or mesh in three dimensions");
  EXPECT_EQ(message_of([&] { read_gmsh<2, 1>(quarter(2, 1, kinds[0]), {"flood"}, TriangleGeometry::plane); }),
            "flood: there is no physical surface of this name; nearest: fluid; the file has fluid");
}

/// Two triangles of the unit square; the diagonal's middle at `middle`, nodes of the second in clockwise order.
std::string square(const Point& middle) {
  std::string content =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"fluid\"\n$EndPhysicalNames\n$Nodes\n9\n"
      "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0.5 0 0\n6 1 0.5 0\n7 0.5 1 0\n8 0 0.5 0\n9 ";
  for (const double value : middle) content += std::to_string(value) + " ";
  return content + "\n$EndNodes\n$Elements\n2\n11 9 2 1 1 1 2 3 5 6 9\n12 9 2 1 1 1 4 3 8 7 9\n$EndElements\n";
}

TEST_F(GmshOrders, TurnsTrianglesCounterClockwise) {
  const auto mesh = read_gmsh<2, 2>(text(square({0.5, 0.5, 0})), {"fluid"}, TriangleGeometry::plane);
  EXPECT_EQ(mesh.cells[0], (std::array<int, 6>{0, 1, 2, 4, 5, 8}));
  EXPECT_EQ(mesh.cells[1], (std::array<int, 6>{0, 2, 3, 8, 6, 7}));
}

TEST_F(GmshOrders, RefusesFoldedCellsByName) {
  const auto read = [&](const Point& middle) {
    return message_of([&] { read_gmsh<2, 2>(text(square(middle)), {"fluid"}, TriangleGeometry::plane); });
  };
  EXPECT_EQ(read({0.6, 0.4, 0}), "accepted");
  // Moved towards (1, 0) by (s, -s): det J of triangle 11 is 1 - 4 s at both ends of the diagonal.
  const auto message = read({0.76, 0.24, 0});
  EXPECT_EQ(message.substr(0, 60), "element 11 of fluid: folded by its curved edges: det J is -0");
  EXPECT_NE(message.find("mm; mesh finer where the geometry curves"), std::string::npos);
  EXPECT_EQ(read({0.24, 0.76, 0}).substr(0, 19), "element 12 of fluid");
  EXPECT_EQ(message_of([&] {
              read_gmsh<2, 1>(text(square({0.76, 0.24, 0})), {"fluid"}, TriangleGeometry::plane);
            }),
            "accepted");
}

}  // namespace
}  // namespace fsi
