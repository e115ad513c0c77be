#include "meshes/curved_lumen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "mesh/flat_parts.hpp"
#include "mesh/point_math.hpp"
#include "mesher/curved_columns.hpp"
#include "mesher/surface/smooth_edges.hpp"
#include "mesher/wall_growth.hpp"

namespace fsi {

EdgeCurves curves_of_lumen(const TetrahedralMesh& lumen, const std::string& on, const Levels& layers, std::string& said,
                           MeshWarnings& warnings) {
  const auto facets = facets_to_grow_on(lumen, on);
  auto smooth = smooth_edges(lumen.nodes, facets, normals_to_grow_along(lumen, facets, 0));
  said += to_text(smooth);
  const bool plain = layers.nodes.empty();
  add_straightened(
      plain ? straighten_folded(lumen, smooth.curves) : straighten_folded_columns(lumen, layers, smooth.curves),
      "the lumen's surface", warnings);
  if (plain) return std::move(smooth.curves);
  said += "Edges in the layers follow them.\n";
  return with_columns(lumen, layers, smooth.curves);
}

void add_straightened(const std::vector<Point>& middles, const std::string& whose, MeshWarnings& warnings) {
  constexpr std::size_t most = 4;
  if (middles.empty()) return;
  std::string places;
  for (std::size_t i = 0; i < std::min(most, middles.size()); ++i) places += (i > 0 ? ", " : "") + place_of(middles[i]);
  if (middles.size() > most) places += fmt::format(" and {} more", middles.size() - most);
  warnings.push_back(
      fmt::format("{} edges of {} are left straight, since curved ones fold cells: at {}; give smaller facets there",
                  middles.size(), whose, places));
}

std::string changed_volume(const std::string& before_text, double before, const std::string& after_text, double after) {
  return fmt::format("The lumen's volume is {:.5g} mm^3 with {} edges and {:.5g} with {} ones ({:+.2f} %).\n", before,
                     before_text, after, after_text, 100 * (after / before - 1));
}

double straight_volume(const TetrahedralMesh& lumen) {
  double volume = 0;
  for (const auto& cell : lumen.cells) {
    std::array<Point, 4> x;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = lumen.nodes[cell[k]];
    volume += simplex_volume<3>(x.data());
  }
  return volume;
}

}  // namespace fsi
