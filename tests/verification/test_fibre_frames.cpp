// Fibre frames by the wall's own potentials: of a straight tube they are the cylinder's, of a bent one the torus's, to
// second order with curved quadratic elements and between first and second with linear ones; and what a wall without
// faces to hold the potentials is told.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/error.hpp"
#include "fem/elements.hpp"
#include "fem/function_space.hpp"
#include "mesh/group_names.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "scene/fibre_frame.hpp"
#include "support/errors.hpp"
#include "support/meshes.hpp"
#include "wall/fibre_directions.hpp"

namespace fsi::test {

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

/// Angles between fibres around and along the tube and the tube's directions, radians: the mean squares' roots and the
/// largest, at all quadrature points of both layers.
struct Angles {
  double mean[2] = {0, 0}, largest[2] = {0, 0};
};
template <class Element>
Angles angles_of(const Tube& tube, int m) {
  const auto mesh = tube.mesh<Element>(m);
  const auto part = split_between_regions(whole(mesh));
  const auto fields = frame_fields<Element>(part, frame_boundary<Element>(mesh, part, {0, 1}, "case.toml"));
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

std::string complaint(const std::function<void(TetrahedralMesh&)>& change) {
  auto mesh = Tube{}.mesh<P1Tetrahedron>(1);
  change(mesh);
  try {
    frame_boundary<P1Tetrahedron>(mesh, whole(mesh), {0, 1}, "case.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FibreFrames, NeedInnerAndOuterFacesAndTwoEnds) {
  EXPECT_EQ(complaint([](auto&) {}), "");
  EXPECT_EQ(complaint([](auto& mesh) { mesh.facet_groups[0].facets.clear(); }),
            "case.toml: structure.fibre_frame: the frame \"laplace\" runs from the inner to the outer face of the "
            "wall, and it has "
            "no inner face; name the inner face inner in the mesh, or set fibre_frame = \"cylinder\"");
  EXPECT_EQ(complaint([](auto& mesh) {
              mesh.facet_groups[0].facets.clear();
              for (const auto& facet : boundary_facets(mesh)) mesh.facet_groups[0].facets.push_back(facet.nodes);
            }),
            "case.toml: structure.fibre_frame: the frame \"laplace\" runs from the inner to the outer face of the "
            "wall, and it has "
            "no outer face; leave a part of the boundary without a name, or set fibre_frame = \"cylinder\"");
  EXPECT_EQ(
      complaint([](auto& mesh) {
        auto& ends = mesh.facet_groups[1].facets;
        ends.resize(ends.size() / 2);
      }),
      "case.toml: structure.fibre_frame: the frame \"laplace\" runs from one end of the wall to the others, and the "
      "surface "
      "wall_ends has 1 connected piece on this wall; name two or more end faces of the wall wall_ends in the mesh, "
      "or set fibre_frame = \"cylinder\"");
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

}  // namespace fsi::test
