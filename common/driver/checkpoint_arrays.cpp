#include "driver/checkpoint_arrays.hpp"

#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

#include "fem/dimensions.hpp"
#include "fem/nodal_layout.hpp"

namespace fsi {

namespace {

using Row = std::pair<std::string_view, ArrayKind>;

// Of the state, and of a wall's prestress.
constexpr std::array whole_names{Row{"wall_velocity", ArrayKind::wall_vectors},
                                 Row{"wall_velocity_before", ArrayKind::wall_vectors},
                                 Row{"wall_acceleration", ArrayKind::wall_vectors},
                                 Row{"rate.wall_velocity", ArrayKind::wall_vectors},
                                 Row{"displacement", ArrayKind::wall_vectors},
                                 Row{"wall", ArrayKind::wall},
                                 Row{"rate.loads", ArrayKind::alike},
                                 Row{"level_times", ArrayKind::alike},
                                 Row{"balance_times", ArrayKind::alike},
                                 Row{"since_jump", ArrayKind::alike},
                                 Row{"inserted_steps", ArrayKind::alike},
                                 Row{"step_lengths", ArrayKind::alike}};
// Behind the last dot: of levels, balances, rates and points of linearisation.
constexpr std::array fields{Row{"mesh", ArrayKind::mesh}, Row{"mesh_reference", ArrayKind::mesh},
                            Row{"flow", ArrayKind::flow}, Row{"flow_reference", ArrayKind::flow},
                            Row{"wall", ArrayKind::wall}, Row{"windkessel", ArrayKind::alike}};
// Of what steppers keep besides.
constexpr std::array memories{Row{"support_loads", ArrayKind::alike}, Row{"opening_pressures", ArrayKind::alike},
                              Row{"windkessels", ArrayKind::alike},   Row{"opening_values", ArrayKind::alike},
                              Row{"v", ArrayKind::interface_columns}, Row{"w", ArrayKind::interface_columns},
                              Row{"a", ArrayKind::interface_columns}, Row{"b", ArrayKind::interface_columns},
                              Row{"age", ArrayKind::alike},           Row{"load0", ArrayKind::interface},
                              Row{"load1", ArrayKind::interface},     Row{"load2", ArrayKind::interface}};
constexpr std::array marches{Row{"controller", ArrayKind::alike}, Row{"estimate", ArrayKind::alike}};
constexpr std::array statistics{Row{"times", ArrayKind::alike},
                                Row{"now", ArrayKind::shear_vectors},
                                Row{"integral", ArrayKind::shear_vectors},
                                Row{"magnitude", ArrayKind::shear_scalars},
                                Row{"mean", ArrayKind::shear_scalars},
                                Row{"oscillation", ArrayKind::shear_scalars},
                                Row{"residence", ArrayKind::shear_scalars}};

template <std::size_t size>
std::optional<ArrayKind> find(const std::array<Row, size>& rows, std::string_view name) {
  for (const auto& [known, kind] : rows)
    if (known == name) return kind;
  return {};
}

bool begins_with(std::string_view text, std::string_view prefix) {
  return text.substr(0, prefix.size()) == prefix;
}

std::vector<char> owned_of(const PartNodes& part, const std::vector<int>& nodes) {
  std::vector<char> owned;
  for (const int node : nodes) owned.push_back(part.owns(node) ? 1 : 0);
  return owned;
}

/// Of some nodes of the fluid, ascending as on one process.
WholeOrder order_of(const PartNodes& part, const std::vector<int>& nodes) {
  std::vector<std::int64_t> keys;
  for (const int node : nodes) keys.push_back(part.share->whole_node[static_cast<std::size_t>(node)]);
  return WholeOrder::by_keys(part.processes(), keys, owned_of(part, nodes));
}

}  // namespace

std::optional<ArrayKind> kind_of_array(const std::string& name) {
  const std::string_view text = name;
  const std::string_view last = text.substr(text.rfind('.') + 1);  // all of it where there is no dot
  const auto behind = [&](const char* prefix) { return text.substr(std::strlen(prefix)); };
  if (begins_with(text, digest_prefix)) return ArrayKind::alike;
  if (begins_with(text, march_prefix)) return find(marches, behind(march_prefix));
  if (begins_with(text, statistics_prefix)) return find(statistics, behind(statistics_prefix));
  if (begins_with(text, memory_prefix)) {
    const auto of_memory = find(memories, last);
    return of_memory ? of_memory : find(fields, last);
  }
  if (const auto kind = find(whole_names, text)) return kind;
  const bool numbered = begins_with(text, "level") || begins_with(text, "balance");
  if (!(numbered || begins_with(text, "rate.")) || last.size() == text.size()) return {};
  return find(fields, last);
}

template <int n>
ArrayOrders<n>::ArrayOrders(const Scene<n>& scene, const std::vector<int>* shear_nodes)
    : processes_(scene.processes()), coupled_(scene.coupled()) {
  if (processes_.is_alone()) return;
  if (scene.fluid) fluid_.emplace(*scene.fluid->nodes().share);
  if (scene.wall) wall_.emplace(*scene.wall->nodes().share);
  if (scene.coupled()) {
    std::vector<int> nodes;
    for (const auto& pair : scene.interface) nodes.push_back(pair.fluid);
    interface_.emplace(order_of(scene.fluid->nodes(), nodes));
  }
  if (shear_nodes != nullptr) shear_.emplace(order_of(scene.fluid->nodes(), *shear_nodes));
}

template <int n>
std::optional<SharedArray> ArrayOrders<n>::of(const std::string& name) const {
  const auto kind = kind_of_array(name);
  if (processes_.is_alone() || !kind) return {};
  const auto shared = [](const std::optional<WholeOrder>& order, int entries,
                         bool columns = false) -> std::optional<SharedArray> {
    if (!order) return {};
    return SharedArray{&*order, entries, columns};
  };
  switch (*kind) {
    case ArrayKind::alike:
      break;
    case ArrayKind::mesh:
      if (coupled_) return shared(fluid_, VectorLayout<n>::entries);
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
  }
  return {};
}

#define FSI_INSTANTIATE(n) template class ArrayOrders<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
