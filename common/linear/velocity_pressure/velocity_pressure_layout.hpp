#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "fem/nodal_layout.hpp"
#include "linear/interface/linear_solver.hpp"

namespace fsi {

/// The unknowns of a scene without mesh motion as one velocity over fluid and wall, and the pressures: the wall's
/// displacement is d = wall_factor v, on the interface both media have the same node (condensed as in [Failer2020],
/// here by the numbering). In statics v stands for the displacement itself. Nodes are ordered as in the whole mesh, so
/// that neighbours are close. Vectors: n numbers for each velocity node, then one for each pressure. A node
/// of which only some components are unknowns has a place for all n; the others stay zero. Where the scene is shared out
/// among processes, ghosts of their velocities and pressures have places behind this process's own.
template <int n>
class VelocityPressureLayout {
 public:
  int velocities = 0;  ///< nodes that can move
  int pressures = 0;
  int own_velocities = 0, own_pressures = 0;             ///< of these, the first, without ghosts
  std::vector<int> velocity_of_fluid, velocity_of_wall;  ///< per node of the part; -1 where it is prescribed
  std::vector<int> pressure_of_fluid, pressure_of_wall;  ///< per node of the part; -1 where it has none
  std::vector<int> fluid_of_velocity, wall_of_velocity;  ///< per velocity node, the first of its nodes; -1: none
  std::vector<int> node_of_pressure;                     ///< per pressure, node of its part
  std::vector<char> wall_pressure;                       ///< per pressure: it is the wall's
  double wall_factor = 1;                                ///< ms: d = wall_factor v, as of the last update()

  explicit VelocityPressureLayout(const JacobianBlocks<n>& blocks) : numbering_(blocks.numbering) {
    struct Node {
      bool ghost;
      int place;  ///< in the whole mesh; the fluid first where both are
      bool wall;
      int part;
    };
    std::vector<Node> nodes;
    // Equations and unknowns stand at the same places.
    assert(same_places(numbering_.fluid, numbering_.fluid_rows) && same_places(numbering_.wall, numbering_.wall_rows));
    const int fluid_nodes = blocks.fluid ? blocks.fluid->graph->rows() : 0;
    const int wall_nodes = blocks.wall ? blocks.wall->graph->rows() : 0;
    for (const bool wall : {false, true}) {
      const PartNodes* part = wall ? blocks.wall_nodes : blocks.fluid_nodes;
      for (int a = 0; a < (wall ? wall_nodes : fluid_nodes); ++a)
        nodes.push_back({!part->owns(a), part->mesh_node[a], wall, a});
    }
    std::sort(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) {
      return std::tuple(a.ghost, a.place, a.wall, a.part) < std::tuple(b.ghost, b.place, b.wall, b.part);
    });
    velocity_of_fluid.assign(fluid_nodes, -1);
    pressure_of_fluid = velocity_of_fluid;
    velocity_of_wall.assign(wall_nodes, -1);
    pressure_of_wall = velocity_of_wall;
    std::vector<std::pair<int, PartNode>> joined;  // nodes with their velocity
    std::vector<int> velocity_of_unknown(numbering_.columns(), -1);
    for (const Node& node : nodes) {
      const UnknownMap& map = node.wall ? numbering_.wall : numbering_.fluid;
      const std::size_t first = MixedLayout<n>::vector(node.part);
      int velocity = -1;  // that of the node's partner on the interface or original, if it came before
      bool moves = false;
      for (int k = 0; k < n; ++k) {
        const auto unknown = map[first + k].index;
        moves = moves || unknown >= 0;
        if (unknown >= 0 && velocity < 0) velocity = velocity_of_unknown[unknown];
      }
      if (moves) {
        if (velocity < 0) {
          velocity = velocities++;
          own_velocities += !node.ghost;
          fluid_of_velocity.push_back(-1);
          wall_of_velocity.push_back(-1);
          entries_.resize(entries_.size() + n);
        }
        for (int k = 0; k < n; ++k) {
          const auto unknown = map[first + k].index;
          Entry& entry = entries_[VectorLayout<n>::vector(velocity, k)];
          if (unknown < 0) {
            partly_fixed_ = true;
          } else if (entry.unknown < 0) {
            entry = {unknown, node.wall, first + k};
            velocity_of_unknown[unknown] = velocity;
          }
        }
        (node.wall ? velocity_of_wall : velocity_of_fluid)[node.part] = velocity;
        int& first_of_part = (node.wall ? wall_of_velocity : fluid_of_velocity)[velocity];
        if (first_of_part < 0) first_of_part = node.part;
        joined.push_back({velocity, {node.wall, node.part}});
      }
      if (map[first + n].index < 0) continue;
      (node.wall ? pressure_of_wall : pressure_of_fluid)[node.part] = pressures++;
      own_pressures += !node.ghost;
      pressure_unknown_.push_back(map[first + n].index);
      node_of_pressure.push_back(node.part);
      wall_pressure.push_back(node.wall);
    }
    list_nodes_of_velocities(std::move(joined));
    velocity_scale_.resize(entries_.size());
    update();
  }

  /// A node of one medium.
  struct PartNode {
    bool wall;
    int node;
  };
  /// Calls visit(PartNode) for the nodes that have this velocity, the fluid's first.
  template <class Visit>
  void for_nodes_of(int velocity, Visit visit) const {
    for (int at = node_offsets_[velocity]; at < node_offsets_[velocity + 1]; ++at) visit(nodes_of_velocities_[at]);
  }
  /// It is the first of the nodes that have its velocity.
  bool is_first(bool wall, int node, int velocity) const {
    const PartNode& first = nodes_of_velocities_[node_offsets_[velocity]];
    return first.wall == wall && first.node == node;
  }

  /// Reads the factors that hold now between velocities and the system's unknowns.
  void update() {
    wall_factor = numbering_.interface.period;
    // The system's unknown x gives v = unknown.factor x in the fluid and d = x = wall_factor v in the wall.
    for (std::size_t i = 0; i < entries_.size(); ++i)
      if (entries_[i].unknown >= 0)
        velocity_scale_[i] = entries_[i].wall ? wall_factor : 1 / numbering_.fluid[entries_[i].place].factor;
  }

  /// Some velocity node has a component that is no unknown of one of its media.
  bool partly_fixed() const { return partly_fixed_; }
  /// Component k of a node of the part is an unknown.
  bool is_free(bool wall, int node, int k) const {
    return (wall ? numbering_.wall : numbering_.fluid)[MixedLayout<n>::vector(node, k)].index >= 0;
  }
  /// Component k of a velocity node is an unknown, in one medium at least.
  bool is_free(int velocity, int k) const { return entries_[VectorLayout<n>::vector(velocity, k)].unknown >= 0; }

  /// Factor of a pressure's row: the wall's volume condition is divided by wall_factor, so that the Schur complement is
  /// symmetric where the Jacobian is.
  double row_scale(int pressure) const { return wall_pressure[pressure] ? 1 / wall_factor : 1; }

  std::size_t velocity_size() const { return static_cast<std::size_t>(velocities) * n; }
  std::size_t size() const { return velocity_size() + pressures; }

  /// Equations of the system that belong to these unknowns, in this order; zero where there is none, as at ghosts.
  void take(const std::vector<double>& system, std::vector<double>& mine) const {
    mine.resize(size());
    const auto equation = [&](std::int64_t unknown) {
      return unknown < 0 || unknown >= numbering_.size ? 0 : system[unknown];
    };
    for (std::size_t i = 0; i < velocity_size(); ++i) mine[i] = equation(entries_[i].unknown);
    for (int p = 0; p < pressures; ++p) mine[velocity_size() + p] = equation(pressure_unknown_[p]);
  }
  /// Writes velocities and pressures, of size(), as the system's unknowns, of Numbering::columns(). Other unknowns
  /// stay.
  void give(const std::vector<double>& mine, std::vector<double>& system) const {
    for (std::size_t i = 0; i < velocity_size(); ++i)
      if (entries_[i].unknown >= 0) system[entries_[i].unknown] = velocity_scale_[i] * mine[i];
    for (int p = 0; p < pressures; ++p) system[pressure_unknown_[p]] = mine[velocity_size() + p];
  }

 private:
  /// But for ghosts, which have no equations here.
  [[maybe_unused]] bool same_places(const UnknownMap& unknowns, const UnknownMap& rows) const {
    return std::equal(unknowns.begin(), unknowns.end(), rows.begin(), rows.end(),
                      [this](const Unknown& unknown, const Unknown& row) {
                        return (unknown.index < 0 || unknown.index >= numbering_.size) == (row.index < 0);
                      });
  }

  void list_nodes_of_velocities(std::vector<std::pair<int, PartNode>> joined) {
    std::stable_sort(joined.begin(), joined.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    node_offsets_.assign(static_cast<std::size_t>(velocities) + 1, 0);
    for (const auto& [velocity, node] : joined) {
      ++node_offsets_[velocity + 1];
      nodes_of_velocities_.push_back(node);
    }
    std::partial_sum(node_offsets_.begin(), node_offsets_.end(), node_offsets_.begin());
  }

  /// Where a component of a velocity stands in the system.
  struct Entry {
    std::int64_t unknown = -1;  ///< none
    bool wall = false;          ///< the medium whose map names it: the fluid's where both do
    std::size_t place = 0;      ///< in that map
  };

  const Numbering& numbering_;
  std::vector<Entry> entries_;     ///< n for each velocity node
  std::vector<int> node_offsets_;  ///< per velocity, into the list that follows
  std::vector<PartNode> nodes_of_velocities_;
  std::vector<std::int64_t> pressure_unknown_;
  std::vector<double> velocity_scale_;  ///< system's unknown over v
  bool partly_fixed_ = false;
};

}  // namespace fsi
