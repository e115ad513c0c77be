#include "mesh/mesh_hash.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include "base/hash.hpp"
#include "mesh/for_each_mesh.hpp"

namespace fsi {

namespace {

/// With its size before it: where one part ends and the next begins counts too.
template <class Value>
void add(Fnv1a& hash, const std::vector<Value>& values) {
  const std::uint64_t size = values.size();
  hash.add(&size, sizeof(size));
  hash.add(values.data(), values.size() * sizeof(Value));
}

void add(Fnv1a& hash, const std::string& name) {
  const std::uint64_t size = name.size();
  hash.add(&size, sizeof(size));
  hash.add(name);
}

}  // namespace

template <int Dim, int Order>
std::string hash_of_mesh(const SimplexMesh<Dim, Order>& mesh) {
  Fnv1a hash;
  add(hash, mesh.nodes);
  add(hash, mesh.cells);
  std::map<std::string, std::vector<int>> volumes;
  for (std::size_t cell = 0; cell < mesh.cell_region.size(); ++cell)
    volumes[mesh.regions[mesh.cell_region[cell]]].push_back(static_cast<int>(cell));
  for (const auto& [name, cells] : volumes) {
    add(hash, name);
    add(hash, cells);
  }
  std::map<std::string, std::vector<typename SimplexMesh<Dim, Order>::Facet>> surfaces;
  for (const auto& group : mesh.facet_groups)
    if (!group.facets.empty()) surfaces[group.name] = group.facets;
  for (auto& [name, facets] : surfaces) {
    std::sort(facets.begin(), facets.end());
    add(hash, name);
    add(hash, facets);
  }
  return hash.hex();
}

#define INSTANTIATE(Dim, Order) template std::string hash_of_mesh(const SimplexMesh<Dim, Order>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
