#include "mesh/facets.hpp"

#include <tuple>

#include "base/bucket_sort.hpp"
#include "mesh/for_each_mesh.hpp"

namespace fsi {

template <int Dim, int Order>
std::vector<FacetUse<Dim>> sorted_facet_uses(const SimplexMesh<Dim, Order>& mesh) {
  using Use = FacetUse<Dim>;
  std::vector<Use> uses;
  uses.reserve((Dim + 1) * mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto facets = outward_facets<Dim, Order>(mesh.cells[c]);
    for (int i = 0; i <= Dim; ++i) uses.push_back({facet_key<Dim>(facets[i]), static_cast<int>(c), i});
  }
  bucket_sort(
      uses, mesh.nodes.size(), [](const Use& use) { return use.key[0]; },
      [](const Use& a, const Use& b) { return std::tie(a.key, a.cell, a.local) < std::tie(b.key, b.cell, b.local); });
  return uses;
}

// Numbers as template arguments: parentheses would only hide them.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define INSTANTIATE(Dim, Order) \
  template std::vector<FacetUse<Dim>> sorted_facet_uses<Dim, Order>(const SimplexMesh<Dim, Order>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fsi
