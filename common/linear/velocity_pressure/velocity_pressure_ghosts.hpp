#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "linear/velocity_pressure/velocity_pressure_layout.hpp"
#include "parallel/exchange.hpp"

namespace fsi {

/// Velocities and pressures of a layout among those of all processes. By all processes together.
template <int n>
struct VelocityPressureGhosts {
  ShareOfNumbers velocities, pressures;

  VelocityPressureGhosts(const JacobianBlocks<n>& blocks, const VelocityPressureLayout<n>& layout) {
    const Communicator& processes = *blocks.numbering.processes;
    constexpr int entries = 2;
    std::vector<double> numbers[entries];  // per velocity, per pressure
    const int own[entries] = {layout.own_velocities, layout.own_pressures};
    for (int kind = 0; kind < entries; ++kind) {
      const auto first = processes.sum_before(std::int64_t{own[kind]});
      numbers[kind].assign(kind == 0 ? layout.velocities : layout.pressures, -1.0);
      for (int i = 0; i < own[kind]; ++i) numbers[kind][i] = static_cast<double>(first + i);
    }
    // Ghosts get the numbers that their owners gave, node by node of each medium.
    for (const bool wall : {false, true}) {
      const PartNodes* part = wall ? blocks.wall_nodes : blocks.fluid_nodes;
      if (part == nullptr || !part->share) continue;
      const std::vector<int>* places[entries] = {wall ? &layout.velocity_of_wall : &layout.velocity_of_fluid,
                                                 wall ? &layout.pressure_of_wall : &layout.pressure_of_fluid};
      std::vector<double> of_nodes(places[0]->size() * entries, -1.0);
      const auto for_places = [&](auto visit) {
        for (std::size_t a = 0; a < places[0]->size(); ++a)
          for (int kind = 0; kind < entries; ++kind)
            if (const int i = (*places[kind])[a]; i >= 0) visit(kind, i, of_nodes[a * entries + kind]);
      };
      for_places([&](int kind, int i, double& number) { number = numbers[kind][i]; });
      part->share->exchange.update(of_nodes, entries);
      for_places([&](int kind, int i, double number) {
        if (i >= own[kind]) numbers[kind][i] = number;
      });
    }
    const auto share = [&](int kind) {
      return ShareOfNumbers(processes, own[kind],
                            std::vector<std::int64_t>(numbers[kind].begin() + own[kind], numbers[kind].end()));
    };
    velocities = share(0);
    pressures = share(1);
  }
};

}  // namespace fsi
