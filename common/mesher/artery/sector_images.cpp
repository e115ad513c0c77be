#include "mesher/artery/sector_images.hpp"

#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "math/pi.hpp"
#include "mesh/mirror.hpp"

namespace fsi {

namespace {

/// A point of the sector in its image number `image`: every second one is turned, the others are turned and mirrored.
Point image_of(const Point& x, int image, int degrees) {
  const bool mirrored = image % 2 == 1;
  const double angle = pi / 180 * degrees * (mirrored ? image + 1 : image), c = std::cos(angle), s = std::sin(angle);
  return mirrored ? Point{c * x[0] + s * x[1], s * x[0] - c * x[1], x[2]}
                  : Point{c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
}

}  // namespace

TetrahedralMesh joined_with_sector_images(const TetrahedralMesh& sector, int degrees, const char* first,
                                          const char* second) {
  const int images = 360 / degrees;
  assert(images >= 4 && images % 2 == 0 && 360 % degrees == 0);
  std::vector<char> on_first(sector.nodes.size(), 0), on_second(on_first);
  const auto mark = [&](const char* name, std::vector<char>& marks) {
    for (const auto& facet : *sector.facets(name))
      for (const int node : facet) marks[node] = 1;
  };
  mark(first, on_first);
  mark(second, on_second);

  TetrahedralMesh tube;
  tube.regions = sector.regions;
  for (const auto& group : sector.facet_groups)
    if (group.name != first && group.name != second) tube.facet_groups.push_back({group.name, {}});
  std::vector<std::vector<int>> number(images, std::vector<int>(sector.nodes.size(), -1));  // per image and node
  for (int image = 0; image < images; ++image) {
    for (std::size_t i = 0; i < sector.nodes.size(); ++i) {
      // A mirror image has its second plane first. Behind it lies the image before; behind the other, the last one's,
      // the sector itself.
      const bool mirrored = image % 2 == 1;
      const bool seam = mirrored ? on_second[i] : on_first[i], far_seam = mirrored ? on_first[i] : on_second[i];
      int& here = number[image][i];
      if (image > 0 && seam)
        here = number[image - 1][i];
      else if (image + 1 == images && far_seam)
        here = number[0][i];
      if (here >= 0) continue;
      here = static_cast<int>(tube.nodes.size());
      tube.nodes.push_back(image == 0 ? sector.nodes[i] : image_of(sector.nodes[i], image, degrees));
    }
    const auto moved = [&](auto simplex) {
      for (int& node : simplex) node = number[image][node];
      return simplex;
    };
    for (const auto& cell : sector.cells) tube.cells.push_back(image % 2 == 0 ? moved(cell) : reversed<3>(moved(cell)));
    tube.cell_region.insert(tube.cell_region.end(), sector.cell_region.begin(), sector.cell_region.end());
    auto to = tube.facet_groups.begin();
    for (const auto& group : sector.facet_groups) {
      if (group.name == first || group.name == second) continue;
      for (const auto& facet : group.facets)
        to->facets.push_back(image % 2 == 0 ? moved(facet) : reversed<2>(moved(facet)));
      ++to;
    }
  }
  return tube;
}

}  // namespace fsi
