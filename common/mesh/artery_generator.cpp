#include "mesh/artery_generator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/error.hpp"
#include "base/names.hpp"
#include "mesh/group_names.hpp"
#include "mesh/quality.hpp"

namespace fsi {

namespace {

constexpr double pi = 3.14159265358979323846;

struct Level {
  const char* name;
  double size, axial_size;
};
// The axial size spends what the cross-section leaves of the paper's node count.
constexpr Level levels[] = {{"coarse", 0.75, 0.78}, {"intermediate", 0.375, 0.34}, {"fine", 0.1875, 0.168}};

// Rings thinner than the elements are long: bending and the pressure drop across the wall need more points through the
// thickness than along it, and one ring of the coarse media stays one ring of its own thickness.
constexpr double ring_to_size = 0.35;

/// Whole numbers that the sizes come to.
struct Divisions {
  int disk_rings;         ///< rings of triangles in the lumen; the circumference has six times as many edges
  int media, adventitia;  ///< rings in the layers
  int axial;

  int around() const { return 6 * disk_rings; }
  int disk_nodes() const { return 1 + 3 * disk_rings * (disk_rings + 1); }
};

void require(bool good, const std::string& option, double value, const std::string& remedy) {
  if (!good) throw InputError("fsi-mesh", option, fmt::format("{} mm will not do", value), remedy);
}

Divisions divide(const ArteryOptions& o) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  require(positive(o.inner_radius), "--inner-radius", o.inner_radius, "give a positive radius");
  require(positive(o.media), "--media", o.media, "give a positive thickness");
  require(std::isfinite(o.adventitia) && o.adventitia >= 0, "--adventitia", o.adventitia,
          "give a positive thickness, or 0 for a wall of media alone");
  require(positive(o.length), "--length", o.length, "give a positive length");
  require(positive(o.size), "--size", o.size, "give a positive element size");
  const double axial_size = o.axial_size.value_or(o.size);
  require(positive(axial_size), "--axial-size", axial_size, "give a positive element size");

  const double disk_rings = std::max(2.0, std::round(2 * pi * o.inner_radius / (6 * o.size)));
  const double media = std::max(1.0, std::round(o.media / (ring_to_size * o.size)));
  const double adventitia = o.adventitia > 0 ? std::max(1.0, std::round(o.adventitia / (ring_to_size * o.size))) : 0;
  const double axial = std::max(2.0, std::round(o.length / axial_size));

  const double nodes = (1 + 3 * disk_rings * (disk_rings + 1) + 6 * disk_rings * (media + adventitia)) * (axial + 1);
  if (!(nodes <= max_artery_nodes)) {
    const bool across = axial_size >= o.size;
    throw InputError("fsi-mesh", across ? "--size" : "--axial-size",
                     fmt::format("{} mm asks for {:.3g} nodes", across ? o.size : axial_size, nodes),
                     fmt::format("give a larger one, for at most {:.3g} nodes", max_artery_nodes));
  }
  return {static_cast<int>(disk_rings), static_cast<int>(media), static_cast<int>(adventitia), static_cast<int>(axial)};
}

/// A triangulated cross-section of lumen and wall.
struct CrossSection {
  /// At angle 2 pi step / steps; the centre has steps = 0.
  struct Node {
    double radius;
    int step, steps;
  };
  std::vector<Node> nodes;                      ///< from the centre outwards
  std::vector<std::array<int, 3>> triangles;    ///< counter-clockwise
  std::vector<int> region;                      ///< per triangle: 0 fluid, 1 media, 2 adventitia
  std::vector<std::array<int, 2>> outer_edges;  ///< counter-clockwise
};

/// Where node `j` of ring `k` of the disk stands in the node list; ring 0 is the centre, ring k has 6k nodes.
int disk_index(int k, int j) {
  return k == 0 ? 0 : 1 + 3 * k * (k - 1) + j % (6 * k);
}

CrossSection cross_section(const ArteryOptions& options, const Divisions& divisions) {
  CrossSection section;
  const auto add_triangle = [&](int a, int b, int c, int region) {
    section.triangles.push_back({a, b, c});
    section.region.push_back(region);
  };

  const int rings = divisions.disk_rings, around = divisions.around();
  section.nodes.push_back({0, 0, 0});
  for (int k = 1; k <= rings; ++k)
    for (int j = 0; j < 6 * k; ++j) section.nodes.push_back({options.inner_radius * k / rings, j, 6 * k});
  for (int k = 1; k <= rings; ++k)
    for (int sector = 0; sector < 6; ++sector)
      for (int i = 0; i < k; ++i) {
        const int outer = sector * k + i, inner = sector * (k - 1) + i;
        add_triangle(disk_index(k, outer), disk_index(k, outer + 1), disk_index(k - 1, inner), 0);
        if (i + 1 < k)
          add_triangle(disk_index(k - 1, inner), disk_index(k, outer + 1), disk_index(k - 1, inner + 1), 0);
      }

  int below = disk_index(rings, 0), ring = 0;  // first node of the last ring so far
  double radius = options.inner_radius;
  const auto add_layer = [&](double thickness, int count, int region) {
    for (int r = 1; r <= count; ++r) {
      ++ring;
      const int above = static_cast<int>(section.nodes.size());
      for (int j = 0; j < around; ++j) section.nodes.push_back({radius + thickness * r / count, j, around});
      for (int j = 0; j < around; ++j) {
        const int next = (j + 1) % around;
        const int a = below + j, b = below + next, c = above + next, d = above + j;
        if ((j + ring) % 2 == 0) {  // diagonals lean both ways in turn
          add_triangle(a, d, c, region);
          add_triangle(a, c, b, region);
        } else {
          add_triangle(a, d, b, region);
          add_triangle(d, c, b, region);
        }
      }
      below = above;
    }
    radius += thickness;
  };
  add_layer(options.media, divisions.media, 1);
  if (divisions.adventitia > 0) add_layer(options.adventitia, divisions.adventitia, 2);
  for (int j = 0; j < around; ++j) section.outer_edges.push_back({below + j, below + (j + 1) % around});
  return section;
}

/// Cross-sections stacked along the axis, every second one turned by half a step around: triangles on the cylinders
/// come out nearly equilateral instead of right-angled, which lifts the mean ratio by a tenth.
class Stack {
 public:
  Stack(const CrossSection& section, const Divisions& divisions, const ArteryOptions& options)
      : section_(section), stations_(divisions.axial + 1), length_(options.length) {
    // Stations closer than half an edge around are better left in line.
    const double edge = 2 * pi * options.inner_radius / divisions.around();
    turn_ = length_ / divisions.axial >= 0.5 * edge ? pi / divisions.around() : 0.0;
  }

  Point node(int station, int i) const {
    const auto& node = section_.nodes[i];
    const double z = length_ * station / (stations_ - 1);
    if (node.steps == 0) return {0, 0, z};
    const double angle = 2 * pi * node.step / node.steps + (station % 2 == 1 ? turn_ : 0.0);
    return {node.radius * std::cos(angle), node.radius * std::sin(angle), z};
  }

  /// Whether the diagonal of the face over edge ab starts from a below (and ends at b above): the shorter one, that
  /// leans against the turn. Adjacent prisms agree, as it depends on the edge only; within a triangle it is an order,
  /// so that the three diagonals of a prism never chase each other and three tetrahedra fill it [Dompierre1999].
  /// Where lengths are equal, inner nodes come first.
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

}  // namespace

std::vector<std::string> artery_levels() {
  std::vector<std::string> names;
  for (const auto& level : levels) names.emplace_back(level.name);
  return names;
}

ArteryOptions artery_level(const std::string& name) {
  for (const auto& level : levels)
    if (name == level.name) {
      ArteryOptions options;
      options.size = level.size;
      options.axial_size = level.axial_size;
      return options;
    }
  throw InputError(
      "fsi-mesh", "--level", fmt::format("there is no level '{}'", name),
      fmt::format("nearest: {}; levels are {}", nearest_name(name, artery_levels()), one_of(artery_levels())));
}

namespace {

/// Dimensions that differ by many orders of magnitude give tetrahedra that rounding would turn inside out.
void refuse_flat(const TetrahedralMesh& mesh) {
  constexpr double least = 1e-3;
  for (const auto& cell : mesh.cells) {
    const double eta = mean_ratio({mesh.nodes[cell[0]], mesh.nodes[cell[1]], mesh.nodes[cell[2]], mesh.nodes[cell[3]]});
    if (!(eta >= least))
      throw InputError("fsi-mesh", "--size",
                       fmt::format("tetrahedra of mean ratio {:.3g}, flatter than {}", eta, least),
                       "choose dimensions and sizes that are nearer to each other");
  }
}

}  // namespace

TetrahedralMesh generate_artery(const ArteryOptions& options) {
  const auto divisions = divide(options);
  const auto section = cross_section(options, divisions);
  const Stack stack(section, divisions, options);
  const int per_station = static_cast<int>(section.nodes.size());

  TetrahedralMesh mesh;
  mesh.regions = {group::fluid, "media"};
  if (divisions.adventitia > 0) mesh.regions.emplace_back("adventitia");
  mesh.nodes.reserve(static_cast<std::size_t>(per_station) * (divisions.axial + 1));
  for (int station = 0; station <= divisions.axial; ++station)
    for (int i = 0; i < per_station; ++i) mesh.nodes.push_back(stack.node(station, i));

  mesh.cells.reserve(3 * section.triangles.size() * divisions.axial);
  for (int slab = 0; slab < divisions.axial; ++slab)
    for (std::size_t t = 0; t < section.triangles.size(); ++t) {
      auto triangle = section.triangles[t];
      const auto first = std::min_element(triangle.begin(), triangle.end(),
                                          [&](int a, int b) { return stack.starts_below(a, b, slab); });
      std::rotate(triangle.begin(), first, triangle.end());
      const int p = triangle[0] + slab * per_station, q = triangle[1] + slab * per_station,
                r = triangle[2] + slab * per_station;
      const int p1 = p + per_station, q1 = q + per_station, r1 = r + per_station;
      if (stack.starts_below(triangle[1], triangle[2], slab))
        mesh.cells.insert(mesh.cells.end(), {{p, q, r, r1}, {p, q, r1, q1}, {p, q1, r1, p1}});
      else
        mesh.cells.insert(mesh.cells.end(), {{p, q, r, q1}, {p, r, r1, q1}, {p, q1, r1, p1}});
      mesh.cell_region.insert(mesh.cell_region.end(), 3, section.region[t]);
    }

  TetrahedralMesh::FacetGroup inlet{group::inlet, {}}, outlet{group::outlet, {}}, ends{group::wall_ends, {}},
      outer{group::outer, {}};
  const int top = divisions.axial * per_station;
  for (std::size_t t = 0; t < section.triangles.size(); ++t) {
    const auto& [a, b, c] = section.triangles[t];
    const bool fluid = section.region[t] == 0;
    (fluid ? inlet : ends).facets.push_back({a, c, b});
    (fluid ? outlet : ends).facets.push_back({a + top, b + top, c + top});
  }
  for (int slab = 0; slab < divisions.axial; ++slab)
    for (const auto& [i, j] : section.outer_edges) {
      const int a = i + slab * per_station, b = j + slab * per_station, a1 = a + per_station, b1 = b + per_station;
      if (stack.starts_below(i, j, slab))
        outer.facets.insert(outer.facets.end(), {{a, b, b1}, {a, b1, a1}});
      else
        outer.facets.insert(outer.facets.end(), {{a, b, a1}, {b, b1, a1}});
    }
  mesh.facet_groups = {inlet, outlet, ends, outer};
  refuse_flat(mesh);
  return mesh;
}

}  // namespace fsi
