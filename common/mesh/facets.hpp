#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// The four facets of a positively oriented tetrahedron, facet i opposite node i, normals pointing out of it.
inline std::array<std::array<int, 3>, 4> outward_facets(const std::array<int, 4>& c) {
  return {{{c[1], c[2], c[3]}, {c[0], c[3], c[2]}, {c[0], c[1], c[3]}, {c[0], c[2], c[1]}}};
}

/// The facet's nodes in ascending order: the same for all orientations of one facet.
inline std::array<int, 3> facet_key(std::array<int, 3> facet) {
  std::sort(facet.begin(), facet.end());
  return facet;
}

struct FacetKeyHash {
  std::size_t operator()(const std::array<int, 3>& key) const {
    std::uint64_t h = 0;
    for (const int node : key) h = (h ^ static_cast<std::uint64_t>(node)) * 0x9E3779B97F4A7C15ull;
    return static_cast<std::size_t>(h ^ (h >> 29));
  }
};

/// One cell's use of a facet.
struct FacetUse {
  std::array<int, 3> key;  ///< facet_key of the facet
  int cell;
  int local;  ///< facet opposite local node `local` of the cell
};

/// All facets of all cells, sorted by key, then cell: the users of one facet stand side by side.
std::vector<FacetUse> sorted_facet_uses(const TetrahedralMesh& mesh);

}  // namespace fsi
