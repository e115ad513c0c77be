#include "mesher/artery/cross_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "base/error.hpp"
#include "mesh/group_names.hpp"
#include "mesher/artery/graded_line.hpp"

namespace fsi {

namespace {

void add_triangle(CrossSection& section, int a, int b, int c, int region) {
  section.triangles.push_back({a, b, c});
  section.region.push_back(region);
}

/// The quadrilateral between nodes a, b of one ring and d, c above them, cut by the diagonal ac or bd.
void add_quadrilateral(CrossSection& section, int a, int b, int c, int d, bool from_a, int region) {
  if (from_a) {
    add_triangle(section, a, d, c, region);
    add_triangle(section, a, c, b, region);
  } else {
    add_triangle(section, a, d, b, region);
    add_triangle(section, d, c, b, region);
  }
}

/// Where node `j` of ring `k` of the hexagonal disk stands in the node list; ring 0 is the centre, ring k has 6k nodes.
int disk_index(int k, int j) {
  return k == 0 ? 0 : 1 + 3 * k * (k - 1) + j % (6 * k);
}

}  // namespace

CrossSection hexagonal_section(const ArteryShape& shape, const ArteryCells& cells) {
  assert(cells.around == 6 * cells.lumen);
  CrossSection section;
  const int rings = cells.lumen, around = cells.around;
  section.nodes.push_back({0, 0, 0, 0});
  for (int k = 1; k <= rings; ++k)
    for (int j = 0; j < 6 * k; ++j) section.nodes.push_back({shape.inner_radius * k / rings, j, 6 * k, k});
  for (int k = 1; k <= rings; ++k)
    for (int sector = 0; sector < 6; ++sector)
      for (int i = 0; i < k; ++i) {
        const int outer = sector * k + i, inner = sector * (k - 1) + i;
        add_triangle(section, disk_index(k, outer), disk_index(k, outer + 1), disk_index(k - 1, inner), 0);
        if (i + 1 < k)
          add_triangle(section, disk_index(k - 1, inner), disk_index(k, outer + 1), disk_index(k - 1, inner + 1), 0);
      }

  int below = disk_index(rings, 0), ring = 0;  // first node of the last ring so far
  double radius = shape.inner_radius;
  const auto add_layer = [&](double thickness, int count, int region) {
    for (int r = 1; r <= count; ++r) {
      ++ring;
      const int above = static_cast<int>(section.nodes.size());
      for (int j = 0; j < around; ++j)
        section.nodes.push_back({radius + thickness * r / count, j, around, rings + ring});
      for (int j = 0; j < around; ++j) {
        const int next = (j + 1) % around;
        add_quadrilateral(section, below + j, below + next, above + next, above + j, (j + ring) % 2 == 0, region);
      }
      below = above;
    }
    radius += thickness;
  };
  add_layer(shape.media, cells.media, 1);
  if (shape.adventitia > 0) add_layer(shape.adventitia, cells.adventitia, 2);
  section.sides.push_back({group::outer, {}});
  for (int j = 0; j < around; ++j) section.sides[0].edges.push_back({below + j, below + (j + 1) % around});
  return section;
}

namespace {

/// How many times the sector goes into the circle.
int sectors_in_circle(const ArteryCells& cells, int degrees) {
  if (degrees <= 0 || 360 % degrees != 0)
    throw InputError("fsi-mesh", "--sector", fmt::format("{} degrees will not do", degrees),
                     "give a whole part of the circle, like 45, 60, 90 or 180, or 360 for the whole tube");
  const int sectors = 360 / degrees;
  if (cells.around % sectors != 0 || cells.around < 2 * sectors)
    throw InputError(
        "fsi-mesh", "--around",
        fmt::format("{} cells cannot be shared by {} sectors of {} degrees", cells.around, sectors, degrees),
        fmt::format("give a multiple of {}, at least {}", sectors, 2 * sectors));
  return sectors;
}

/// One circle of nodes, or its part in a sector.
struct Ring {
  int first;   ///< its first node in the list
  int cells;   ///< in the sector
  bool whole;  ///< the last cell ends where the first begins
  int node(int j) const { return first + (whole ? j % cells : j); }
};

/// Triangles between two rings of different numbers of cells, always along the shorter, by angle, of the two next
/// edges.
void join(CrossSection& section, const Ring& inner, const Ring& outer, int region) {
  int i = 0, j = 0;
  while (i < inner.cells || j < outer.cells) {
    // Angles in units of the sector / (inner.cells * outer.cells): from the next inner node to j, from i to the next
    // outer node.
    const std::int64_t back =
        static_cast<std::int64_t>(i + 1) * outer.cells - static_cast<std::int64_t>(j) * inner.cells;
    const std::int64_t ahead =
        static_cast<std::int64_t>(j + 1) * inner.cells - static_cast<std::int64_t>(i) * outer.cells;
    if (i == inner.cells || (j < outer.cells && ahead <= back)) {
      add_triangle(section, outer.node(j), outer.node(j + 1), inner.node(i), region);
      ++j;
    } else {
      add_triangle(section, inner.node(i), outer.node(j), inner.node(i + 1), region);
      ++i;
    }
  }
}

}  // namespace

CrossSection ring_section(const ArteryShape& shape, const ArteryCells& cells, int degrees) {
  require_cells(shape, cells);
  const int sectors = sectors_in_circle(cells, degrees);
  const bool whole = sectors == 1;
  const int around = cells.around / sectors;
  // Two cells at least between planes that meet: else a tetrahedron at the axis has all its nodes on the planes.
  const int first_ring = std::min(around, std::max(6 / sectors, 2));

  CrossSection section;
  std::vector<Ring> rings;
  section.nodes.push_back({0, 0, 0, 0});
  const auto add_ring = [&](double radius, int count) {
    rings.push_back({static_cast<int>(section.nodes.size()), count, whole});
    for (int j = 0; j < count + (whole ? 0 : 1); ++j)
      section.nodes.push_back({radius, j, count * sectors, static_cast<int>(rings.size())});
  };
  const auto fill = [&](int region) {  // between the last two rings
    const Ring &inner = rings[rings.size() - 2], &outer = rings.back();
    if (inner.cells != outer.cells) {
      join(section, inner, outer, region);
      return;
    }
    for (int j = 0; j < outer.cells; ++j)
      add_quadrilateral(section, inner.node(j), inner.node(j + 1), outer.node(j + 1), outer.node(j),
                        (j + rings.size()) % 2 == 0, region);
  };

  const auto radii = graded_line(shape.inner_radius, cells.lumen, cells.lumen_grading);
  for (int k = 1; k <= cells.lumen; ++k) {
    // The interface needs all cells even where a single ring leads there.
    const bool last = k == cells.lumen;
    add_ring(radii[k], last ? around : static_cast<int>(std::min<std::int64_t>(around, std::int64_t{first_ring} * k)));
    if (k == 1)
      for (int j = 0; j < rings[0].cells; ++j) add_triangle(section, rings[0].node(j), rings[0].node(j + 1), 0, 0);
    else
      fill(0);
  }
  double radius = shape.inner_radius;
  const auto add_layer = [&](double thickness, int count, int region) {
    for (int r = 1; r <= count; ++r) {
      add_ring(radius + thickness * r / count, around);
      fill(region);
    }
    radius += thickness;
  };
  add_layer(shape.media, cells.media, 1);
  if (shape.adventitia > 0) add_layer(shape.adventitia, cells.adventitia, 2);

  section.sides.push_back({group::outer, {}});
  for (int j = 0; j < around; ++j) section.sides[0].edges.push_back({rings.back().node(j), rings.back().node(j + 1)});
  if (whole) return section;

  std::vector<std::array<int, 2>> start, end;
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const int from = k == 0 ? 0 : rings[k - 1].node(0), to = k == 0 ? 0 : rings[k - 1].node(rings[k - 1].cells);
    start.push_back({from, rings[k].node(0)});
    end.push_back({rings[k].node(rings[k].cells), to});
  }
  if (sectors == 2) {
    start.insert(start.end(), end.begin(), end.end());
    section.sides.push_back({group::symmetry[1], start});
  } else {
    section.sides.push_back({sectors == 4 ? group::symmetry[0] : group::oblique_symmetry, end});
    section.sides.push_back({group::symmetry[1], start});
  }
  return section;
}

}  // namespace fsi
