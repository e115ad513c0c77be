#include "mesh/facets.hpp"

#include <tuple>

namespace fsi {

std::vector<FacetUse> sorted_facet_uses(const TetrahedralMesh& mesh) {
  std::vector<FacetUse> uses;
  uses.reserve(4 * mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto facets = outward_facets(mesh.cells[c]);
    for (int i = 0; i < 4; ++i) uses.push_back({facet_key(facets[i]), static_cast<int>(c), i});
  }
  std::sort(uses.begin(), uses.end(), [](const FacetUse& a, const FacetUse& b) {
    return std::tie(a.key, a.cell, a.local) < std::tie(b.key, b.cell, b.local);
  });
  return uses;
}

}  // namespace fsi
