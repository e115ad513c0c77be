#include "mesher/artery_generator.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "math/pi.hpp"
#include "mesh/cell_words.hpp"
#include "mesh/group_names.hpp"
#include "mesh/quality.hpp"
#include "mesher/artery/cross_section.hpp"
#include "mesher/artery/extrusion.hpp"
#include "mesher/artery/graded_line.hpp"

namespace fsi {

namespace {

/// Cross-sections stacked along the axis, every second one turned by half a step around: triangles on the cylinders
/// come out nearly equilateral instead of right-angled, which lifts the mean ratio by a tenth.
class TurnedStack {
 public:
  TurnedStack(const CrossSection& section, const ArteryShape& shape, const ArteryCells& cells)
      : section_(section), stations_(cells.axial + 1), length_(shape.length) {
    // Stations closer than half an edge around are better left in line.
    const double edge = 2 * pi * shape.inner_radius / cells.around;
    turn_ = length_ / cells.axial >= 0.5 * edge ? pi / cells.around : 0.0;
  }

  Point node(int station, int i) const {
    const auto& node = section_.nodes[i];
    const double z = length_ * station / (stations_ - 1);
    if (node.steps == 0) return {0, 0, z};
    const double angle = 2 * pi * node.step / node.steps + (station % 2 == 1 ? turn_ : 0.0);
    return {node.radius * std::cos(angle), node.radius * std::sin(angle), z};
  }

  /// The shorter diagonal, that leans against the turn. Where lengths are equal, inner nodes come first.
  bool starts_below(int a, int b, int slab) const {
    const auto &from = section_.nodes[a], &to = section_.nodes[b];
    if (from.steps == 0 || to.steps == 0) return from.steps == 0;
    const std::int64_t full = static_cast<std::int64_t>(from.steps) * to.steps;
    std::int64_t ahead =
        static_cast<std::int64_t>(from.step) * to.steps - static_cast<std::int64_t>(to.step) * from.steps;
    if (2 * ahead > full) ahead -= full;
    if (2 * ahead < -full) ahead += full;
    if (ahead == 0) return a < b;
    return (ahead > 0) == (slab % 2 == 0);
  }

 private:
  const CrossSection& section_;
  int stations_;
  double length_, turn_;
};

/// Cross-sections stacked in line at given heights. Nodes are coloured like a chessboard over rings and steps;
/// diagonals start at one colour in even slabs and at the other in odd ones, so that they alternate both ways on every
/// cylinder.
class LinedUpStack {
 public:
  LinedUpStack(const CrossSection& section, std::vector<double> heights)
      : section_(section), heights_(std::move(heights)) {}

  Point node(int station, int i) const {
    const auto& node = section_.nodes[i];
    if (node.steps == 0) return {0, 0, heights_[station]};
    const auto [x, y] = on_circle(node.step, node.steps);
    return {node.radius * x, node.radius * y, heights_[station]};
  }

  bool starts_below(int a, int b, int slab) const {
    if (slab % 2 == 1) std::swap(a, b);
    return std::pair(colour(a), a) < std::pair(colour(b), b);
  }

 private:
  int colour(int i) const { return (section_.nodes[i].ring + section_.nodes[i].step) % 2; }

  /// The unit circle at 2 pi step / steps, a quarter turn exactly on an axis.
  static std::array<double, 2> on_circle(int step, int steps) {
    const std::int64_t quarters = std::int64_t{4} * step;
    const double angle = 0.5 * pi * static_cast<double>(quarters % steps) / steps;
    double x = std::cos(angle), y = std::sin(angle);
    for (std::int64_t turn = quarters / steps; turn > 0; --turn) x = -std::exchange(y, x);
    return {x + 0.0, y + 0.0};  // no negative zeros
  }

  const CrossSection& section_;
  std::vector<double> heights_;
};

/// Dimensions that differ by many orders of magnitude give cells that rounding would turn inside out; rings that are
/// graded closer together than their polygons allow give some that are.
template <int Dim>
void refuse_flat(const SimplexMesh<Dim>& mesh, const char* if_flat, const char* if_inverted, const char* remedy) {
  constexpr double least = 1e-3;
  for (const auto& cell : mesh.cells) {
    std::array<Point, Dim + 1> corners;
    for (int a = 0; a <= Dim; ++a) corners[a] = mesh.nodes[cell[a]];
    const double eta = mean_ratio(corners);
    if (!(eta >= least))
      throw InputError("fsi-mesh", eta < 0 ? if_inverted : if_flat,
                       fmt::format("{} of mean ratio {:.3g}, flatter than {}", CellWords<Dim>::cells, eta, least),
                       remedy);
  }
}

constexpr const char* less_flat = "choose dimensions, numbers of cells and gradings for less flat cells";

std::vector<double> stations(const ArteryShape& shape, const ArteryCells& cells) {
  return graded_line(shape.length, cells.axial, 1 / cells.axial_grading);
}

}  // namespace

TetrahedralMesh generate_artery(const ArteryOptions& options) {
  const auto cells = artery_cells(options);
  const auto section = hexagonal_section(options, cells);
  const TurnedStack stack(section, options, cells);
  auto mesh = extrude(
      section, options.adventitia > 0, cells.axial, [&](int station, int i) { return stack.node(station, i); },
      [&](int a, int b, int slab) { return stack.starts_below(a, b, slab); });
  refuse_flat(mesh, "--size", "--size", "choose dimensions and sizes that are nearer to each other");
  return mesh;
}

TetrahedralMesh generate_artery(const ArteryShape& shape, const ArteryCells& cells, int sector_degrees) {
  const auto section = ring_section(shape, cells, sector_degrees);
  const LinedUpStack stack(section, stations(shape, cells));
  auto mesh = extrude(
      section, shape.adventitia > 0, cells.axial, [&](int station, int i) { return stack.node(station, i); },
      [&](int a, int b, int slab) { return stack.starts_below(a, b, slab); });
  refuse_flat(mesh, "--axial-cells", "--lumen-grading", less_flat);
  return mesh;
}

TriangleMesh generate_artery_section(const ArteryShape& shape, const ArteryCells& cells) {
  require_cells(shape, cells);
  auto radii = graded_line(shape.inner_radius, cells.lumen, cells.lumen_grading);
  std::vector<int> region(cells.lumen, 0);  // per cell between radii
  const auto add_layer = [&](double thickness, int count, int number) {
    const double from = radii.back();
    for (int r = 1; r <= count; ++r) radii.push_back(from + thickness * r / count);
    region.insert(region.end(), count, number);
  };
  add_layer(shape.media, cells.media, 1);
  if (shape.adventitia > 0) add_layer(shape.adventitia, cells.adventitia, 2);
  const auto heights = stations(shape, cells);
  const int across = static_cast<int>(region.size());
  const auto node = [&](int i, int k) { return k * (across + 1) + i; };

  TriangleMesh mesh;
  mesh.regions = {group::fluid, "media"};
  if (shape.adventitia > 0) mesh.regions.emplace_back("adventitia");
  for (const double z : heights)
    for (const double r : radii) mesh.nodes.push_back({r, 0, z});
  for (int k = 0; k < cells.axial; ++k)
    for (int i = 0; i < across; ++i) {
      const int a = node(i, k), b = node(i + 1, k), c = node(i + 1, k + 1), d = node(i, k + 1);
      if ((i + k) % 2 == 0)
        mesh.cells.insert(mesh.cells.end(), {{a, b, c}, {a, c, d}});
      else
        mesh.cells.insert(mesh.cells.end(), {{a, b, d}, {b, c, d}});
      mesh.cell_region.insert(mesh.cell_region.end(), 2, region[i]);
    }

  TriangleMesh::FacetGroup inlet{group::inlet, {}}, outlet{group::outlet, {}}, ends{group::wall_ends, {}},
      outer{group::outer, {}};
  for (int i = 0; i < across; ++i) {
    (region[i] == 0 ? inlet : ends).facets.push_back({node(i, 0), node(i + 1, 0)});
    (region[i] == 0 ? outlet : ends).facets.push_back({node(i + 1, cells.axial), node(i, cells.axial)});
  }
  for (int k = 0; k < cells.axial; ++k) outer.facets.push_back({node(across, k), node(across, k + 1)});
  mesh.facet_groups = {inlet, outlet, ends, outer};
  refuse_flat(mesh, "--axial-cells", "--lumen-grading", less_flat);
  return mesh;
}

}  // namespace fsi
