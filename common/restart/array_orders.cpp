#include "restart/array_orders.hpp"

#include <cstdint>

#include "fem/dimensions.hpp"
#include "fem/nodal_layout.hpp"

namespace fsi {

namespace {

std::vector<char> owned_of(const PartNodes& part, const std::vector<int>& nodes) {
  std::vector<char> owned;
  for (const int node : nodes) owned.push_back(part.owns(node) ? 1 : 0);
  return owned;
}

/// The order of some nodes of the fluid, ascending as on one process.
WholeOrder order_of(const PartNodes& part, const std::vector<int>& nodes) {
  std::vector<std::int64_t> keys;
  for (const int node : nodes) keys.push_back(part.share->whole_node[static_cast<std::size_t>(node)]);
  return WholeOrder::by_keys(part.processes(), keys, owned_of(part, nodes));
}

}  // namespace

template <int n>
ArrayOrders<n>::ArrayOrders(const Scene<n>& scene, const std::vector<int>* shear_nodes, CellShare fluid, CellShare wall)
    : scene_(scene),
      shear_nodes_(shear_nodes == nullptr ? 0 : shear_nodes->size()),
      fluid_cells_(fluid),
      wall_cells_(wall) {
  if (processes().is_alone()) return;
  if (scene.fluid) fluid_.emplace(*scene.fluid->nodes().share);
  if (scene.wall) wall_.emplace(*scene.wall->nodes().share);
  if (scene.coupled()) {
    std::vector<int> nodes;
    for (const auto& pair : scene.interface) nodes.push_back(pair.fluid);
    interface_.emplace(order_of(scene.fluid->nodes(), nodes));
  }
  if (shear_nodes != nullptr) shear_.emplace(order_of(scene.fluid->nodes(), *shear_nodes));
  if (scene.wall && scene.wall->branch_places().entries > 0) {
    const BranchPlaces& places = scene.wall->branch_places();
    branches_.emplace(WholeOrder::by_keys(processes(), places.whole_cell, places.counted));
  }
}

template <int n>
std::optional<SharedArray> ArrayOrders<n>::of(ArrayKind kind) const {
  const auto shared = [](const std::optional<WholeOrder>& order, int entries,
                         bool columns = false) -> std::optional<SharedArray> {
    if (!order) return {};
    return SharedArray{&*order, entries, columns};
  };
  switch (kind) {
    case ArrayKind::alike:
    case ArrayKind::support_loads:
    case ArrayKind::opening_values:
      break;
    case ArrayKind::mesh:
      if (scene_.coupled()) return shared(fluid_, VectorLayout<n>::entries);
      break;
    case ArrayKind::flow:
      return shared(fluid_, MixedLayout<n>::entries);
    case ArrayKind::wall:
      return shared(wall_, MixedLayout<n>::entries);
    case ArrayKind::wall_vectors:
      return shared(wall_, VectorLayout<n>::entries);
    case ArrayKind::interface:
      return shared(interface_, n);
    case ArrayKind::interface_columns:
      return shared(interface_, n, true);
    case ArrayKind::shear_vectors:
      return shared(shear_, 3);
    case ArrayKind::shear_scalars:
      return shared(shear_, 1);
    case ArrayKind::fluid_cells:
    case ArrayKind::wall_cells:
      if (const auto* order = (kind == ArrayKind::fluid_cells ? fluid_cells_ : wall_cells_).order)
        return SharedArray{order, 2, false};
      break;
    case ArrayKind::wall_branches:
      if (scene_.wall) return shared(branches_, static_cast<int>(scene_.wall->branch_places().entries));
      break;
  }
  return {};
}

template <int n>
ArraySharing ArrayOrders<n>::sharing(const std::map<std::string, ArrayKind>& kinds) const {
  return [this, &kinds](const std::string& name) -> std::optional<SharedArray> {
    const auto kind = kinds.find(name);
    return kind == kinds.end() ? std::nullopt : of(kind->second);
  };
}

template <int n>
std::optional<std::size_t> ArrayOrders<n>::length(ArrayKind kind, const State& rest) const {
  switch (kind) {
    case ArrayKind::alike:
      break;
    case ArrayKind::support_loads:
      return rest.support_loads;
    case ArrayKind::opening_values:
      return rest.now.openings.size();
    case ArrayKind::mesh:
      return rest.now.mesh.size();
    case ArrayKind::flow:
      return rest.now.fluid.size();
    case ArrayKind::wall:
      return rest.now.wall.size();
    case ArrayKind::wall_vectors:
      return rest.wall_velocity.size();
    case ArrayKind::interface:
    case ArrayKind::interface_columns:
      return n * scene_.interface.size();
    case ArrayKind::shear_vectors:
      return 3 * shear_nodes_;
    case ArrayKind::shear_scalars:
      return shear_nodes_;
    case ArrayKind::fluid_cells:
      return 2 * fluid_cells_.cells;
    case ArrayKind::wall_cells:
      return 2 * wall_cells_.cells;
    case ArrayKind::wall_branches:
      return rest.now.branches.size();
  }
  return {};
}

#define FSI_INSTANTIATE(n) template class ArrayOrders<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
