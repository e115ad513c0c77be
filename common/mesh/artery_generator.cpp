#include "mesh/artery_generator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

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
  std::vector<std::array<double, 2>> nodes;
  std::vector<std::array<int, 3>> triangles;    ///< counter-clockwise
  std::vector<int> region;                      ///< per triangle: 0 fluid, 1 media, 2 adventitia
  std::vector<std::array<int, 2>> outer_edges;  ///< counter-clockwise
  /// Per node its place in the order that cuts the prisms: the diagonal of an extruded edge starts, below, from the
  /// node that comes first.
  std::vector<int> order;
};

/// Where node `j` of ring `k` of the disk stands in the node list; ring 0 is the centre, ring k has 6k nodes.
int disk_index(int k, int j) {
  return k == 0 ? 0 : 1 + 3 * k * (k - 1) + j % (6 * k);
}

CrossSection cross_section(const ArteryOptions& options, const Divisions& divisions) {
  CrossSection section;
  // Sort key of the cutting order. Wall: columns (nodes at one angle) alternately first and last, so that a triangle,
  // having two nodes in one column, never gets its short radial edge as the extreme pair, which is the flattest cut,
  // and diagonals lean both ways in turn around the tube. Lumen: the three colours of the hexagonal lattice.
  std::vector<std::tuple<int, int, int>> key;
  const auto add_node = [&](double radius, double angle, int first, int second) {
    key.emplace_back(first, second, static_cast<int>(section.nodes.size()));
    section.nodes.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  };
  const auto add_triangle = [&](int a, int b, int c, int region) {
    section.triangles.push_back({a, b, c});
    section.region.push_back(region);
  };

  const int rings = divisions.disk_rings, around = divisions.around();
  add_node(0, 0, 1, 0);
  for (int k = 1; k <= rings; ++k)
    for (int j = 0; j < 6 * k; ++j) {
      const int sector = j / k, step = j % k;
      // Lattice coordinates along the sector's two sides; a - b modulo 3 colours a triangular lattice.
      static constexpr int side[7][2] = {{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}, {1, 0}};
      const int a = side[sector][0] * (k - step) + side[sector + 1][0] * step;
      const int b = side[sector][1] * (k - step) + side[sector + 1][1] * step;
      const int colour = ((a - b) % 3 + 3) % 3;
      const double radius = options.inner_radius * k / rings, angle = 2 * pi * j / (6 * k);
      add_node(radius, angle, k < rings ? colour : 2 * (j % 2), k < rings ? 0 : j % 2);
    }
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
      for (int j = 0; j < around; ++j)
        add_node(radius + thickness * r / count, 2 * pi * j / around, 2 * (j % 2), (j + ring) % 2);
      for (int j = 0; j < around; ++j) {
        const int next = (j + 1) % around;
        const int a = below + j, b = below + next, c = above + next, d = above + j;
        if ((j + ring) % 2 == 0) {
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

  std::sort(key.begin(), key.end());
  section.order.resize(key.size());
  for (std::size_t i = 0; i < key.size(); ++i) section.order[std::get<2>(key[i])] = static_cast<int>(i);
  return section;
}

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
  const int per_station = static_cast<int>(section.nodes.size());

  TetrahedralMesh mesh;
  mesh.regions = {group::fluid, "media"};
  if (divisions.adventitia > 0) mesh.regions.emplace_back("adventitia");
  mesh.nodes.reserve(static_cast<std::size_t>(per_station) * (divisions.axial + 1));
  for (int station = 0; station <= divisions.axial; ++station)
    for (const auto& [x, y] : section.nodes) mesh.nodes.push_back({x, y, options.length * station / divisions.axial});

  // One order of the cross-section's nodes for all prisms gives both prisms at a vertical face the same diagonal, and a
  // prism never three diagonals that chase each other (J. Dompierre et al., 8th Int. Meshing Roundtable, 1999).
  mesh.cells.reserve(3 * section.triangles.size() * divisions.axial);
  for (int slab = 0; slab < divisions.axial; ++slab)
    for (std::size_t t = 0; t < section.triangles.size(); ++t) {
      auto triangle = section.triangles[t];
      const auto first = std::min_element(triangle.begin(), triangle.end(),
                                          [&](int a, int b) { return section.order[a] < section.order[b]; });
      std::rotate(triangle.begin(), first, triangle.end());
      const int p = triangle[0] + slab * per_station, q = triangle[1] + slab * per_station,
                r = triangle[2] + slab * per_station;
      const int p1 = p + per_station, q1 = q + per_station, r1 = r + per_station;
      if (section.order[triangle[1]] < section.order[triangle[2]])
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
      if (section.order[i] < section.order[j])
        outer.facets.insert(outer.facets.end(), {{a, b, b1}, {a, b1, a1}});
      else
        outer.facets.insert(outer.facets.end(), {{a, b, a1}, {b, b1, a1}});
    }
  mesh.facet_groups = {inlet, outlet, ends, outer};
  refuse_flat(mesh);
  return mesh;
}

}  // namespace fsi
