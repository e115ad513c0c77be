#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "system/linear_solver.hpp"

namespace fsi {

/// The unknowns of a scene without mesh motion as one velocity over fluid and wall, and the pressures: the wall's
/// displacement is d = dt v, on the interface both media have the same node (condensed as in [Failer2020],
/// here by the numbering). In statics v stands for the displacement itself. Nodes are ordered as in the
/// whole mesh, so that neighbours are close. Vectors: n numbers for each velocity node, then one for each pressure.
template <class Element>
class VelocityPressureLayout {
 public:
  static constexpr int n = Element::components;

  int velocities = 0;  ///< nodes that can move
  int pressures = 0;
  std::vector<int> velocity_of_fluid, velocity_of_wall;  ///< per node of the part; -1 where it is prescribed
  std::vector<int> pressure_of_fluid, pressure_of_wall;  ///< per node of the part
  std::vector<int> fluid_of_velocity, wall_of_velocity;  ///< per velocity node; -1 outside the part
  std::vector<int> node_of_pressure;                     ///< per pressure, node of its part
  std::vector<char> wall_pressure;                       ///< per pressure: it is the wall's
  double wall_factor = 1;                                ///< d = wall_factor v

  explicit VelocityPressureLayout(const JacobianBlocks<Element>& blocks) {
    const Numbering& numbering = blocks.numbering;
    wall_factor = numbering.interface.period;
    struct Node {
      int place;  ///< in the whole mesh; the fluid first where both are
      bool wall;
      int part;
    };
    std::vector<Node> nodes;
    if (blocks.flow)
      for (int a = 0; a < blocks.scene.fluid->node_count(); ++a)
        nodes.push_back({blocks.scene.fluid->part().mesh_node[a], false, a});
    if (blocks.wall)
      for (int a = 0; a < blocks.scene.wall->node_count(); ++a)
        nodes.push_back({blocks.scene.wall->part().mesh_node[a], true, a});
    std::sort(nodes.begin(), nodes.end(),
              [](const Node& a, const Node& b) { return std::pair(a.place, a.wall) < std::pair(b.place, b.wall); });
    velocity_of_fluid.assign(blocks.flow ? blocks.scene.fluid->node_count() : 0, -1);
    pressure_of_fluid = velocity_of_fluid;
    velocity_of_wall.assign(blocks.wall ? blocks.scene.wall->node_count() : 0, -1);
    pressure_of_wall = velocity_of_wall;
    std::vector<int> velocity_of_unknown(static_cast<std::size_t>(numbering.size), -1);
    for (const Node& node : nodes) {
      const UnknownMap& map = node.wall ? numbering.wall : numbering.flow;
      const Unknown& first = map[static_cast<std::size_t>(node.part) * (n + 1)];
      auto& velocity_of = node.wall ? velocity_of_wall : velocity_of_fluid;
      if (first.index >= 0) {
        int& velocity = velocity_of_unknown[first.index];
        if (velocity < 0) {
          velocity = velocities++;
          fluid_of_velocity.push_back(-1);
          wall_of_velocity.push_back(-1);
          for (int k = 0; k < n; ++k) {
            const Unknown& unknown = map[static_cast<std::size_t>(node.part) * (n + 1) + k];
            velocity_unknown_.push_back(unknown.index);
            // The system's unknown x gives v = unknown.factor x in the fluid and d = x = wall_factor v in the wall.
            velocity_scale_.push_back(node.wall ? wall_factor : 1 / unknown.factor);
          }
        }
        velocity_of[node.part] = velocity;
        (node.wall ? wall_of_velocity : fluid_of_velocity)[velocity] = node.part;
      }
      (node.wall ? pressure_of_wall : pressure_of_fluid)[node.part] = pressures++;
      pressure_unknown_.push_back(map[static_cast<std::size_t>(node.part) * (n + 1) + n].index);
      node_of_pressure.push_back(node.part);
      wall_pressure.push_back(node.wall);
    }
  }

  std::size_t velocity_size() const { return static_cast<std::size_t>(velocities) * n; }
  std::size_t size() const { return velocity_size() + pressures; }

  /// Equations of the system that belong to these unknowns, in this order.
  void take(const std::vector<double>& system, std::vector<double>& mine) const {
    mine.resize(size());
    for (std::size_t i = 0; i < velocity_size(); ++i) mine[i] = system[velocity_unknown_[i]];
    for (int p = 0; p < pressures; ++p) mine[velocity_size() + p] = system[pressure_unknown_[p]];
  }
  /// Writes velocities and pressures as the system's unknowns.
  void give(const std::vector<double>& mine, std::vector<double>& system) const {
    for (std::size_t i = 0; i < velocity_size(); ++i) system[velocity_unknown_[i]] = velocity_scale_[i] * mine[i];
    for (int p = 0; p < pressures; ++p) system[pressure_unknown_[p]] = mine[velocity_size() + p];
  }

 private:
  std::vector<std::int64_t> velocity_unknown_, pressure_unknown_;
  std::vector<double> velocity_scale_;  ///< system's unknown over v
};

}  // namespace fsi
