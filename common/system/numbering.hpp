#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "linear/interface/field_numbering.hpp"
#include "scene/scene.hpp"

namespace fsi {

namespace detail {

/// Gives an unknown of its own, and the equation of the same place, to every component of a vector that
/// `fixed(node, component)` does not prescribe, and to every scalar. Vectors come first in each node. A copy of a node
/// shares its original's vector and has a scalar of its own.
/// \param scalars  whether a node has a scalar
template <int Components, class Fixed, class Scalars>
UnknownMap number_nodes(const PartNodes& part, std::int64_t& next, Fixed fixed, Scalars scalars) {
  using Mixed = MixedLayout<Components>;
  const int nodes = part.node_count();
  UnknownMap map(Mixed::size(nodes));
  for (int a = 0; a < nodes; ++a) {
    const int original = part.original_of(a);
    assert(original <= a);
    for (int k = 0; k < Components; ++k)
      if (original != a)
        map[Mixed::vector(a, k)] = map[Mixed::vector(original, k)];
      else if (!fixed(a, k))
        map[Mixed::vector(a, k)] = {next++, 1.0};
    if (scalars(a)) map[Mixed::scalar(a)] = {next++, 1.0};
  }
  return map;
}
template <int Components, class Fixed>
UnknownMap number_vectors(int nodes, std::int64_t& next, Fixed fixed) {
  using Vector = VectorLayout<Components>;
  UnknownMap map(Vector::size(nodes));
  for (int a = 0; a < nodes; ++a)
    for (int k = 0; k < Components; ++k)
      if (!fixed(a, k)) map[Vector::vector(a, k)] = {next++, 1.0};
  return map;
}

/// The scene's fluid-wall interface as a flag per fluid node.
template <int n>
std::vector<char> on_interface(const Scene<n>& scene) {
  std::vector<char> on(static_cast<std::size_t>(scene.fluid->node_count()), 0);
  for (const auto& node : scene.interface) on[node.fluid] = 1;
  return on;
}

/// Calls visit(map, entries of a node, share) for the maps of a numbering that are not empty, in one order.
template <int n, class AnyNumbering, class Visit>
void for_each_map(const Scene<n>& scene, AnyNumbering& numbering, Visit visit) {
  if (!numbering.mesh.empty()) visit(numbering.mesh, VectorLayout<n>::entries, *scene.fluid->nodes().share);
  if (!numbering.fluid.empty()) visit(numbering.fluid, MixedLayout<n>::entries, *scene.fluid->nodes().share);
  if (!numbering.wall.empty()) visit(numbering.wall, MixedLayout<n>::entries, *scene.wall->nodes().share);
}

/// The unknowns of the entries of nodes, in their order, each once and -1 left out.
inline void unknowns_of(const UnknownMap& map, int entries, const std::vector<int>& nodes, std::vector<char>& seen,
                        std::vector<int>& unknowns) {
  for (const int node : nodes)
    for (int k = 0; k < entries; ++k) {
      const auto unknown = map[static_cast<std::size_t>(node) * entries + k].index;
      if (unknown < 0 || std::exchange(seen[unknown], 1) != 0) continue;
      unknowns.push_back(static_cast<int>(unknown));
    }
}

/// Makes of a numbering of all nodes here, ghosts included, one that is shared out (see Numbering): own unknowns first,
/// no equations at ghosts, and what processes have to tell each other.
template <int n>
void share_out(const Scene<n>& scene, Numbering& numbering) {
  const Communicator& processes = scene.processes();
  if (processes.is_alone()) return;
  const auto all = static_cast<std::size_t>(numbering.size);
  std::vector<char> own(all, 0);
  for_each_map(scene, numbering, [&](const UnknownMap& map, int entries, const NodeShare& share) {
    for (std::size_t i = 0; i < map.size(); ++i)
      if (map[i].index >= 0 && share.owned[i / entries] != 0) own[map[i].index] = 1;
  });
  numbering.processes = &processes;
  numbering.size = std::count(own.begin(), own.end(), 1);
  std::vector<std::int64_t> place(all);
  std::int64_t next_own = 0, next_copy = numbering.size;
  for (std::size_t i = 0; i < all; ++i) place[i] = own[i] != 0 ? next_own++ : next_copy++;
  for (UnknownMap* map : {&numbering.mesh, &numbering.fluid, &numbering.wall})
    for (Unknown& unknown : *map)
      if (unknown.index >= 0) unknown.index = place[unknown.index];
  for (UnknownMap* rows : {&numbering.mesh_rows, &numbering.fluid_rows, &numbering.wall_rows})
    for (Unknown& row : *rows)
      if (row.index >= 0) row.index = own[row.index] != 0 ? place[row.index] : -1;
  const auto elsewhere = [&](bool here) { return processes.any(here); };
  numbering.elsewhere = {
      elsewhere(!numbering.mesh.empty()), elsewhere(!numbering.fluid.empty()), elsewhere(!numbering.wall.empty()),
      elsewhere(!numbering.interface_velocities.empty() || !numbering.interface_displacements.empty())};
  numbering.first = processes.sum_before(numbering.size);
  numbering.whole = processes.sum(numbering.size);
  numbering.ghosts.assign(all - static_cast<std::size_t>(numbering.size), -1);
  // The same entries, in the same order, at both sides: conditions of ghosts are those of their owners.
  std::map<int, Exchange::Neighbour> neighbours;
  std::map<int, std::vector<char>> seen_sent, seen_received;
  for_each_map(scene, numbering, [&](const UnknownMap& map, int entries, const NodeShare& share) {
    std::vector<double> numbers(map.size(), -1);
    for (std::size_t i = 0; i < map.size(); ++i)
      if (share.owned[i / entries] != 0 && map[i].index >= 0)
        numbers[i] = static_cast<double>(numbering.first + map[i].index);
    share.exchange.update(numbers, entries);
    for (std::size_t i = 0; i < map.size(); ++i)
      if (map[i].index >= numbering.size)
        numbering.ghosts[static_cast<std::size_t>(map[i].index - numbering.size)] =
            static_cast<std::int64_t>(numbers[i]);
    for (const auto& with : share.exchange.neighbours()) {
      auto& neighbour = neighbours[with.rank];
      neighbour.rank = with.rank;
      for (auto* seen : {&seen_sent[with.rank], &seen_received[with.rank]}) seen->resize(all, 0);
      unknowns_of(map, entries, with.sent, seen_sent[with.rank], neighbour.sent);
      unknowns_of(map, entries, with.received, seen_received[with.rank], neighbour.received);
    }
  });
  std::vector<Exchange::Neighbour> list;
  for (auto& [rank, neighbour] : neighbours) list.push_back(std::move(neighbour));
  numbering.exchange = Exchange(processes, std::move(list));
}

/// The wall alone, not shared out.
template <int n>
Numbering number_wall_here(const Scene<n>& scene) {
  Numbering part;
  const auto& space = scene.wall->space();
  part.wall = number_nodes<n>(
      scene.wall->nodes(), part.size, [&](int a, int k) { return scene.wall_conditions.fixes(a, k); },
      [&](int a) { return space.carries_scalar(a); });
  part.wall_rows = part.wall;
  return part;
}
template <int n>
Numbering number_fluid_here(const Scene<n>& scene, bool free_interface) {
  Numbering part;
  const auto wet = on_interface(scene);
  const auto& space = scene.fluid->space();
  part.fluid = number_nodes<n>(
      scene.fluid->nodes(), part.size,
      [&](int a, int k) { return scene.velocity_conditions.fixes(a, k) || (wet[a] && !free_interface); },
      [&](int a) { return space.carries_scalar(a); });
  part.fluid_rows = part.fluid;
  return part;
}

}  // namespace detail

/// The fluid alone, its velocity free on the interface or prescribed there (Dirichlet side of the partitioned split).
template <int n>
Numbering number_fluid(const Scene<n>& scene, bool free_interface = false) {
  Numbering part = detail::number_fluid_here(scene, free_interface);
  detail::share_out(scene, part);
  return part;
}

/// The fluid, free on the interface, with its domain. The domain follows the interface's velocity u there,
/// d_m = reference + period u, so derivatives know how it moves.
template <int n>
Numbering number_fluid_and_domain(const Scene<n>& scene) {
  using Vector = VectorLayout<n>;
  Numbering part = detail::number_fluid_here(scene, /*free_interface=*/true);
  const auto wet = detail::on_interface(scene);
  part.mesh = detail::number_vectors<n>(scene.fluid->node_count(), part.size,
                                        [&](int a, int k) { return wet[a] || scene.mesh_conditions.fixes(a, k); });
  part.mesh_rows = part.mesh;
  for (const auto& node : scene.interface)
    for (int k = 0; k < n; ++k) {
      const Unknown velocity = part.fluid[MixedLayout<n>::vector(node.fluid, k)];
      if (velocity.index < 0) continue;
      part.mesh[Vector::vector(node.fluid, k)] = {velocity.index, part.interface.period};
      part.interface_displacements.push_back(Vector::vector(node.fluid, k));
    }
  detail::share_out(scene, part);
  return part;
}

/// The wall alone, free on the interface (Neumann side of the partitioned split). Where layers with pressures of their
/// own meet, they have one displacement and one momentum equation, the sum of theirs.
template <int n>
Numbering number_wall(const Scene<n>& scene) {
  Numbering part = detail::number_wall_here(scene);
  detail::share_out(scene, part);
  return part;
}

/// The mesh motion alone, displacement prescribed on the whole boundary.
template <int n>
Numbering number_mesh_motion(const Scene<n>& scene) {
  Numbering part;
  const auto wet = detail::on_interface(scene);
  part.mesh = detail::number_vectors<n>(scene.fluid->node_count(), part.size,
                                        [&](int a, int k) { return wet[a] || scene.mesh_conditions.fixes(a, k); });
  part.mesh_rows = part.mesh;
  detail::share_out(scene, part);
  return part;
}

/// The one medium of a scene that has only one.
template <int n>
Numbering number_single_medium(const Scene<n>& scene) {
  assert(!scene.coupled());
  return scene.fluid ? number_fluid(scene) : number_wall(scene);
}

}  // namespace fsi
