#pragma once

#include <cstddef>
#include <tuple>
#include <vector>

#include "base/bucket_sort.hpp"
#include "mesh/facets.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// One cell's use of a facet.
template <int Dim = 3>
struct FacetUse {
  FacetKey<Dim> key;  ///< facet_key of the facet
  int cell;
  int local;  ///< facet opposite local vertex `local` of the cell
};

/// Uses of the facets for which takes(cell, key) is true, sorted by key, then cell: those of one facet are adjacent.
/// \param expected  their number, to reserve memory
template <int Dim, int Order, class Takes>
std::vector<FacetUse<Dim>> sorted_facet_uses(const SimplexMesh<Dim, Order>& mesh, Takes takes,
                                             std::size_t expected = 0) {
  using Use = FacetUse<Dim>;
  std::vector<Use> uses;
  uses.reserve(expected);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto facets = outward_facets<Dim, Order>(mesh.cells[c]);
    for (int i = 0; i <= Dim; ++i)
      if (const auto key = facet_key<Dim>(facets[i]); takes(static_cast<int>(c), key))
        uses.push_back({key, static_cast<int>(c), i});
  }
  bucket_sort(
      uses, mesh.nodes.size(), [](const Use& use) { return use.key[0]; },
      [](const Use& a, const Use& b) { return std::tie(a.key, a.cell, a.local) < std::tie(b.key, b.cell, b.local); });
  return uses;
}

/// The uses of all facets, in the same order.
template <int Dim, int Order>
std::vector<FacetUse<Dim>> sorted_facet_uses(const SimplexMesh<Dim, Order>& mesh) {
  return sorted_facet_uses(
      mesh, [](int, const FacetKey<Dim>&) { return true; }, (Dim + 1) * mesh.cells.size());
}

}  // namespace fsi
