// Fibre frames by the wall's own potentials: of a straight tube they are the cylinder's, of a bent one the torus's, to
// second order with curved quadratic elements and between first and second with linear ones; which frame a wall has where
// the case names none; where its ends are found; and what a wall without faces to hold the potentials is told.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

#include "base/error.hpp"
#include "fem/elements.hpp"
#include "fem/function_space.hpp"
#include "mesh/group_names.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "scene/cylindrical_wall.hpp"
#include "scene/fibre_frame.hpp"
#include "support/errors.hpp"
#include "support/meshes.hpp"
#include "wall/fibre_directions.hpp"

namespace fsi::test::fibre_frames_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

const double pi = std::acos(-1.0);
constexpr double radius = 1.5;  // mm, of the inner face

/// A tube of two layers, closed around, along the z axis or bent about the line x = -bend, y = 0 there in the plane of
/// x and z, with groups `inner` and `wall_ends`.
struct Tube {
  double thickness = 0.4, length = 2, bend = 0;  ///< mm; no bend: straight

  Point at(double r, double angle, double along) const {
    const double x = r * std::cos(angle), y = r * std::sin(angle);
    if (bend == 0) return {x, y, along};
    const double turn = along / bend;
    return {(bend + x) * std::cos(turn) - bend, y, (bend + x) * std::sin(turn)};
  }
  /// (e_theta, e_z) of the tube at a place.
  std::array<Vec3<double>, 2> frame(const Vec3<double>& x) const {
    const double out = std::hypot(x[0] + bend, x[2]);
    const Vec3<double> axial =
        bend == 0 ? Vec3<double>{{0, 0, 1}} : Vec3<double>{{-x[2] / out, 0, (x[0] + bend) / out}};
    const Vec3<double> centre = bend == 0 ? Vec3<double>{{0, 0, x[2]}}
                                          : Vec3<double>{{bend * (x[0] + bend) / out - bend, 0, bend * x[2] / out}};
    const Vec3<double> around = cross(axial, x - centre);
    return {(1 / std::sqrt(dot(around, around))) * around, axial};
  }

  template <class Element>
  SimplexMesh<3, Element::order> mesh(int m) const {
    const int around = 12 * m, through = 2 * m, along = 3 * m;
    auto grid = grid_mesh(
        {through, around, along}, {"media", "adventitia"},
        [&](int i, int j, int k) {
          return at(radius + thickness * i / through, 2 * pi * j / around, length * k / along);
        },
        [&](int i, int, int) { return i < m ? 0 : 1; });
    // Close it: the last nodes around are the first ones.
    std::vector<int> number(grid.nodes.size());
    std::vector<Point> nodes;
    for (std::size_t a = 0; a < grid.nodes.size(); ++a) {
      const int i = static_cast<int>(a) % (through + 1), j = static_cast<int>(a) / (through + 1) % (around + 1),
                k = static_cast<int>(a) / ((through + 1) * (around + 1));
      if (j == around) {
        number[a] = number[i + (through + 1) * ((around + 1) * k)];
      } else {
        number[a] = static_cast<int>(nodes.size());
        nodes.push_back(grid.nodes[a]);
      }
    }
    const std::vector<Point> places = grid.nodes;
    std::vector<std::array<double, 2>> of_node(nodes.size());  // (i, k) of the grid
    for (std::size_t a = 0; a < places.size(); ++a)
      of_node[number[a]] = {static_cast<double>(a % (through + 1)),
                            static_cast<double>(a / ((through + 1) * (around + 1)))};
    grid.nodes = nodes;
    for (auto& cell : grid.cells)
      for (int& node : cell) node = number[node];
    for (const auto& [name, which, value] :
         {std::tuple{group::inner, 0, 0}, std::tuple{group::wall_ends, 1, 0}, std::tuple{group::wall_ends, 1, along}}) {
      if (grid.facet_groups.empty() || grid.facet_groups.back().name != name) grid.facet_groups.push_back({name, {}});
      for (const auto& facet : boundary_facets(grid))
        if (std::all_of(facet.nodes.begin(), facet.nodes.end(),
                        [&, w = which, v = value](int node) { return of_node[node][w] == v; }))
          grid.facet_groups.back().facets.push_back(facet.nodes);
    }
    if constexpr (Element::order == 1) {
      return grid;
    } else {
      auto quadratic = with_mid_edge_nodes(grid);
      // Middles of edges on the cylinders and along the bend: the mean of the ends in tube coordinates.
      for (const auto& cell : quadratic.cells)
        for (std::size_t e = 0; e < 6; ++e) {
          const auto& [a, b] = SimplexEdges<3>::vertices[e];
          const auto p = coordinates(quadratic.nodes[cell[a]]), q = coordinates(quadratic.nodes[cell[b]]);
          double angle = (p[1] + q[1]) / 2;
          if (std::abs(p[1] - q[1]) > pi) angle += pi;
          quadratic.nodes[cell[4 + e]] = at((p[0] + q[0]) / 2, angle, (p[2] + q[2]) / 2);
        }
      return quadratic;
    }
  }
  /// (r, angle, along)
  Point coordinates(const Point& x) const {
    if (bend == 0) return {std::hypot(x[0], x[1]), std::atan2(x[1], x[0]), x[2]};
    const double across = std::hypot(x[0] + bend, x[2]) - bend;
    return {std::hypot(across, x[1]), std::atan2(x[1], across), bend * std::atan2(x[2], x[0] + bend)};
  }
};

template <class Element>
FrameBoundary boundary_of(const MeshOf<Element>& mesh, const PartOf<Element>& part) {
  return frame_boundary<Element>(mesh, part, wall_boundary<Element>(mesh, {0, 1}), "case.toml", "the frame");
}

/// Angles between fibres around and along the tube and the tube's directions, radians: the mean squares' roots and the
/// largest, at all quadrature points of both layers.
struct Angles {
  double mean[2] = {0, 0}, largest[2] = {0, 0};
};
template <class Element>
Angles angles_of(const Tube& tube, int m) {
  const auto mesh = tube.mesh<Element>(m);
  const auto part = split_between_regions(whole(mesh));
  const auto fields = frame_fields<Element>(part, boundary_of<Element>(mesh, part));
  const auto space = function_space<Element>(part);
  const ElementPacks<Element> packs(part.nodes, part.cells, all_cells(part), *space.graph());
  Angles angles;
  for (int which : {0, 1}) {
    const auto fibres = fibre_directions(packs, fields, part.cells, which == 0 ? 0 : pi / 2);
    double squares = 0, count = 0;
    for (int t = 0; t < packs.thread_count(); ++t)
      for (std::size_t p = 0; p < fibres[t].size(); ++p)
        for (int q = 0; q < Element::points; ++q) {
          const auto& pack = packs.of_thread(t)[p];
          const auto shapes = Element::at(pack.geometry, q).vectors();
          for (int lane = 0; lane < pack.filled; ++lane) {
            Vec3<double> x{{0, 0, 0}}, found;
            for (int a = 0; a < Element::nodes; ++a)
              for (int i = 0; i < 3; ++i) x[i] += shapes.value[a] * part.nodes[part.cells[pack.cell[lane]][a]][i];
            for (int i = 0; i < 3; ++i) found[i] = fibres[t][p][q].direction[0][i][lane];
            EXPECT_NEAR(dot(found, found), 1, 1e-14);
            const Vec3<double> off = cross(found, tube.frame(x)[which]);
            squares += dot(off, off);
            ++count;
            angles.largest[which] = std::max(angles.largest[which], std::sqrt(dot(off, off)));
          }
        }
    angles.mean[which] = std::sqrt(squares / count);
  }
  return angles;
}

template <class Element>
ConvergenceTable table_of(const std::string& title, const Tube& tube, const std::vector<int>& meshes) {
  ConvergenceTable table(title, {"around, mean", "along, mean", "around, most", "along, most"});
  for (int m : meshes) {
    const Angles found = angles_of<Element>(tube, m);
    table.add(1.0 / m, {found.mean[0], found.mean[1], found.largest[0], found.largest[1]});
  }
  table.print();
  return table;
}

TEST(FibreFrames, OfAStraightTubeAreTheCylinders) {
  const auto p1 = table_of<P1Tetrahedron>("straight, P1", {}, {1, 2, 4});
  const auto p2 = table_of<P2P1Tetrahedron>("straight, P2P1", {}, {1, 2});
  EXPECT_GT(p1.last_order(0), 1.1);
  EXPECT_GT(p1.last_order(1), 1.8);
  for (int direction : {0, 1}) {
    EXPECT_LT(p1.last_error(direction), 4e-3);
    EXPECT_LT(p1.last_error(2 + direction), 6e-3);
    EXPECT_GT(p2.last_order(direction), 1.8);
    EXPECT_LT(p2.last_error(2 + direction), 4e-3);
  }
}

// The angle along the bend is harmonic without flux through the faces: the axial direction is the torus's but for the
// mesh. The radial potential's lines are straight on the faces alone; inside they bow by t^2/(8 bend radius inner
// radius) = 2e-3 at most.
TEST(FibreFrames, OfABentTubeAreTheToruss) {
  const Tube bent{0.4, 4, 6};
  const auto p1 = table_of<P1Tetrahedron>("bent, P1", bent, {1, 2, 4});
  const auto p2 = table_of<P2P1Tetrahedron>("bent, P2P1", bent, {1, 2});
  EXPECT_GT(p1.last_order(1), 1.5);
  EXPECT_GT(p2.last_order(1), 1.8);
  for (int direction : {0, 1}) {
    EXPECT_LT(p1.last_error(direction), 5e-3);
    EXPECT_LT(p1.last_error(2 + direction), 0.012);
    EXPECT_LT(p2.last_error(2 + direction), 0.008);
  }
}

/// A quarter of the tube, 90 degrees about the z axis, with groups `inner` and `wall_ends`; its cuts have no name.
TetrahedralMesh quarter() {
  const Tube tube;
  auto mesh = grid_mesh(
      {2, 4, 3}, {"media", "adventitia"},
      [&](int i, int j, int k) { return tube.at(radius + 0.2 * i, pi / 8 * j, 2.0 / 3 * k); },
      [](int i, int, int) { return i; });
  mesh.facet_groups = {{group::inner, {}}, {group::wall_ends, {}}};
  for (const auto& facet : boundary_facets(mesh)) {
    const auto all = [&](auto lies) {
      return std::all_of(facet.nodes.begin(), facet.nodes.end(), [&](int node) { return lies(mesh.nodes[node]); });
    };
    if (all([](const Point& x) { return std::hypot(x[0], x[1]) < radius + 0.1; }))
      mesh.facet_groups[0].facets.push_back(facet.nodes);
    if (all([](const Point& x) { return x[2] < 0.1; }) || all([](const Point& x) { return x[2] > 1.9; }))
      mesh.facet_groups[1].facets.push_back(facet.nodes);
  }
  return mesh;
}

template <class Mesh>
Mesh along_x(Mesh mesh) {
  for (Point& x : mesh.nodes) x = {x[2], x[0], x[1]};
  return mesh;
}

Case unnamed() {
  Case setup;
  setup.path = "case.toml";
  setup.structure.emplace();
  return setup;
}

template <class Element>
WallFrame chosen(const MeshOf<Element>& mesh, const Case& setup = unnamed()) {
  std::vector<int> regions(mesh.regions.size());
  std::iota(regions.begin(), regions.end(), 0);
  return wall_frame<Element>(setup, mesh, whole(mesh), regions);
}

// A tube that lies along x had the directions of the z axis, and no word was said.
TEST(FibreFrames, AreTheWallsOwnWhereNoneIsNamedUnlessItIsACylinderAboutTheAxis) {
  const auto straight = Tube{}.mesh<P1Tetrahedron>(1);
  const WallFrame about_z = chosen<P1Tetrahedron>(straight);
  EXPECT_EQ(about_z.kind, FibreFrame::cylinder);
  EXPECT_TRUE(about_z.fields.empty());
  EXPECT_EQ(about_z.remark,
            "structure.fibre_frame = cylinder: the case names none, and the wall is a cylinder about the axis through "
            "(0, 0, 0) mm along (0, 0, 1)");
  EXPECT_EQ(chosen<P2P1Tetrahedron>(Tube{}.mesh<P2P1Tetrahedron>(1)).kind, FibreFrame::cylinder);
  EXPECT_EQ(chosen<P1Tetrahedron>(quarter()).kind, FibreFrame::cylinder);

  const auto turned = along_x(straight);
  const WallFrame about_x = chosen<P1Tetrahedron>(turned);
  EXPECT_EQ(about_x.kind, FibreFrame::laplace);
  EXPECT_EQ(about_x.remark,
            "structure.fibre_frame = laplace: the case names none, and the wall is no cylinder about the axis through "
            "(0, 0, 0) mm along (0, 0, 1): fibres follow its own frame, from (0, 0, 0) mm to (2, 0, 0) mm");
  EXPECT_EQ(about_x.notice, "");
  const WallFrame named = [&] {
    Case setup = unnamed();
    setup.structure->fibre_frame = FibreFrame::laplace;
    return chosen<P1Tetrahedron>(turned, setup);
  }();
  EXPECT_EQ(about_x.fields.radial, named.fields.radial);
  EXPECT_EQ(about_x.fields.axial, named.fields.axial);

  Case axis = unnamed();
  axis.structure->axis_direction = {2, 0, 0};
  EXPECT_EQ(chosen<P1Tetrahedron>(turned, axis).kind, FibreFrame::cylinder);
  EXPECT_EQ(chosen<P1Tetrahedron>(straight, axis).kind, FibreFrame::laplace);
  auto aside = straight;
  for (Point& x : aside.nodes) x[0] += 0.5;
  EXPECT_EQ(chosen<P1Tetrahedron>(aside).kind, FibreFrame::laplace);
  EXPECT_EQ(chosen<P1Tetrahedron>(Tube{0.4, 4, 6}.mesh<P1Tetrahedron>(1)).kind, FibreFrame::laplace);
}

TEST(FibreFrames, KnowACylinderByItsShape) {
  const auto is_one = [](const auto& change) {
    auto mesh = Tube{}.mesh<P1Tetrahedron>(2);
    for (Point& x : mesh.nodes) {
      const double angle = std::atan2(x[1], x[0]), factor = change(angle, x[2]);
      x = {factor * x[0], factor * x[1], x[2]};
    }
    return is_cylinder<P1Tetrahedron>(mesh, wall_boundary<P1Tetrahedron>(mesh, {0, 1}), {});
  };
  EXPECT_TRUE(is_one([](double, double) { return 1; }));
  EXPECT_TRUE(is_one([](double angle, double) {  // as 12 flat faces that were refined
    return std::cos(pi / 12) / std::cos(std::remainder(angle - pi / 12, pi / 6));
  }));
  EXPECT_FALSE(is_one([](double, double z) { return 1 + 0.1 * z; })) << "a cone";
  EXPECT_FALSE(is_one([](double, double z) { return 1 - 0.3 * std::exp(-std::pow(4 * (z - 1), 2)); })) << "a stenosis";
  EXPECT_FALSE(is_one([](double angle, double) { return 1 + 0.1 * std::cos(2 * angle); })) << "an oval";

  auto block = grid_mesh(
      {2, 2, 2}, {"media"},
      [](int i, int j, int k) {
        return Point{i - 1.0, j - 1.0, 1.0 * k};
      },
      [](int, int, int) { return 0; });
  EXPECT_FALSE(is_cylinder<P1Tetrahedron>(block, wall_boundary<P1Tetrahedron>(block, {0}), {}));
}

/// A grid of 2 x 4 quadrilaterals, the first direction through the wall, with the group `inner`; ends have no name.
TriangleMesh section(const std::function<Point(int, int)>& place) {
  auto mesh = triangle_grid({2, 4}, {"media"}, place, [](int, int) { return 0; });
  mesh.facet_groups = {{group::inner, {}}};
  for (const auto& facet : boundary_facets(mesh))
    if (facet.nodes[0] % 3 == 0 && facet.nodes[1] % 3 == 0) mesh.facet_groups[0].facets.push_back(facet.nodes);
  return mesh;
}

template <class Element>
void expect_own_frame_through(const TriangleMesh& mesh) {
  EXPECT_EQ(chosen<Element>(mesh).kind, FibreFrame::laplace);
  const FrameBoundary found =
      frame_boundary<Element>(mesh, whole(mesh), wall_boundary<Element>(mesh, {0}), "case.toml", "the frame");
  for (int a = 0; a < static_cast<int>(mesh.nodes.size()); ++a) {
    EXPECT_EQ(found.inner[a] != 0, a % 3 == 0);
    EXPECT_EQ(found.outer[a] != 0, a % 3 == 2) << "ends and the axis have no potential";
  }
}

TEST(FibreFrames, InTwoDimensionsAreChosenLikewise) {
  const auto tube = [](double slope) {
    return section([=](int i, int j) { return Point{1.5 + 0.2 * i + slope * j, 0, 0.5 * j}; });
  };
  EXPECT_EQ(chosen<P1AxisymmetricTriangle>(tube(0)).kind, FibreFrame::cylinder);
  expect_own_frame_through<P1AxisymmetricTriangle>(tube(0.1));
  expect_own_frame_through<P1AxisymmetricTriangle>(section([](int i, int j) {  // a dome, closed on the axis
    const double r = 1.5 + 0.2 * i, angle = pi / 8 * j;
    return Point{j == 4 ? 0 : r * std::cos(angle), 0, r * std::sin(angle)};
  }));
  const auto ring = [](double oval) {
    return section([=](int i, int j) {
      const double r = 1.5 + 0.2 * i, angle = pi / 8 * j;
      return Point{(1 + oval) * r * std::cos(angle), r * std::sin(angle), 0};
    });
  };
  EXPECT_EQ(chosen<P1PlaneTriangle>(ring(0)).kind, FibreFrame::cylinder);
  expect_own_frame_through<P1PlaneTriangle>(ring(0.3));
}

/// What an action is refused with; "" if it is not.
std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}
/// What frame_boundary() says of a mesh after a change.
std::string complaint(TetrahedralMesh mesh, const std::function<void(TetrahedralMesh&)>& change) {
  change(mesh);
  return refusal([&] { boundary_of<P1Tetrahedron>(mesh, whole(mesh)); });
}

std::vector<std::vector<char>> marks(const TetrahedralMesh& mesh) {
  const FrameBoundary boundary = boundary_of<P1Tetrahedron>(mesh, whole(mesh));
  return {boundary.inner, boundary.outer, boundary.start, boundary.end};
}

// Names of ends may be left out, or be those of supports.
TEST(FibreFrames, FindEndsByTheirShape) {
  for (const Tube& tube : {Tube{}, Tube{0.4, 4, 6}}) {
    const auto named = tube.mesh<P1Tetrahedron>(1);
    const auto expected = marks(named);
    auto mesh = named;
    mesh.facet_groups[1].facets.clear();
    EXPECT_EQ(marks(mesh), expected);
    mesh = named;
    mesh.facet_groups[1].facets.resize(named.facet_groups[1].facets.size() / 2);
    EXPECT_EQ(marks(mesh), expected);
    mesh.facet_groups[1].name = "symmetry_z";  // across the vessel
    EXPECT_EQ(marks(mesh), expected);
  }
  auto mesh = quarter();
  const auto found = boundary_of<P1Tetrahedron>(mesh, whole(mesh));
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    const double r = std::hypot(mesh.nodes[a][0], mesh.nodes[a][1]);
    EXPECT_EQ(found.outer[a] != 0, r > radius + 0.3) << "cuts along the vessel have no potential";
    EXPECT_EQ(found.start[a] != 0, mesh.nodes[a][2] < 0.1);
    EXPECT_EQ(found.end[a] != 0, mesh.nodes[a][2] > 1.9);
  }
}

TEST(FibreFrames, NeedInnerAndOuterFacesAndTwoEnds) {
  const auto straight = Tube{}.mesh<P1Tetrahedron>(1);
  EXPECT_EQ(complaint(straight, [](auto&) {}), "");
  EXPECT_EQ(complaint(straight, [](auto& mesh) { mesh.facet_groups[0].facets.clear(); }),
            "case.toml: structure.fibre_frame: the frame runs from the inner to the outer face of the wall, and it has "
            "no inner face; name the inner face inner in the mesh, or set fibre_frame = \"cylinder\"");
  EXPECT_EQ(complaint(straight,
                      [](auto& mesh) {
                        mesh.facet_groups[0].facets.clear();
                        for (const auto& facet : boundary_facets(mesh))
                          mesh.facet_groups[0].facets.push_back(facet.nodes);
                      }),
            "case.toml: structure.fibre_frame: the frame runs from the inner to the outer face of the wall, and it has "
            "no outer face; leave a part of the boundary without a name, or set fibre_frame = \"cylinder\"");
  const std::string ends = complaint(quarter(), [](auto& mesh) { mesh.facet_groups[1].facets.clear(); });
  for (const char* said : {"the frame runs from one end of the wall to the others, and 0 ends are found on this wall",
                           "touch each other: one may be an end and the other a cut", "name two or more end faces"})
    EXPECT_NE(ends.find(said), std::string::npos) << ends;
}

// A frame that is needed and cannot be found ends the run, unless the case names an axis.
TEST(FibreFrames, AreNotGuessed) {
  auto mesh = along_x(Tube{}.mesh<P1Tetrahedron>(1));
  mesh.facet_groups[0].facets.clear();
  EXPECT_EQ(refusal([&] { chosen<P1Tetrahedron>(mesh); }),
            "case.toml: structure.fibre_frame: no frame is named, and the wall is no cylinder about the axis through "
            "(0, 0, 0) mm along (0, 0, 1); its own frame runs from the inner to the outer face of the wall, and it has "
            "no inner face; name the inner face inner in the mesh, or set fibre_frame = \"cylinder\"");
  Case axis = unnamed();
  axis.structure->axis_is_named = true;
  const WallFrame frame = chosen<P1Tetrahedron>(mesh, axis);
  EXPECT_EQ(frame.kind, FibreFrame::cylinder);
  EXPECT_NE(frame.notice.find("though the wall is no cylinder about it"), std::string::npos) << frame.notice;
}

// At a saddle there is no axial direction; the frame is orthonormal all the same.
TEST(FibreFrames, AreOrthonormalWhereAPotentialIsFlat) {
  for (const Vec3<double>& axial : {Vec3<double>{{0, 0, 0}}, Vec3<double>{{0.2, 0.4, 0}}, Vec3<double>{{1, 0, 3}}}) {
    const auto frame = frame_of({{1, 2, 0}}, axial);
    for (const auto& [a, b] : {std::pair{frame.radial, frame.axial}, std::pair{frame.radial, frame.circumferential},
                               std::pair{frame.axial, frame.circumferential}}) {
      EXPECT_NEAR(dot(a, b), 0, 1e-15);
      EXPECT_NEAR(dot(a, a), 1, 1e-15);
      EXPECT_NEAR(dot(b, b), 1, 1e-15);
    }
    EXPECT_NEAR(frame.radial[1], 2 / std::sqrt(5.0), 1e-15);
  }
}

}  // namespace

}  // namespace fsi::test::fibre_frames_tests
