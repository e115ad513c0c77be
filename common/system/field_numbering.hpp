#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fem/unknowns.hpp"
#include "time/interface_kinematics.hpp"

namespace fsi {

/// Which entries of a Solution are unknowns of a system of equations, and which residual rows are its equations. Maps
/// of absent parts are empty. Single components of a node may be without an unknown, and so may its scalar.
struct Numbering {
  std::int64_t size = 0;
  UnknownMap mesh_rows, mesh;    ///< mesh motion: equations, unknowns d_m; vector layout
  UnknownMap fluid_rows, fluid;  ///< momentum and continuity; (u, p_f); mixed layout
  UnknownMap wall_rows, wall;    ///< momentum and volume; (d_s, p_s); mixed layout

  /// Entries of `fluid` whose unknown is the interface's displacement.
  std::vector<std::size_t> interface_velocities;
  /// Entries of `mesh` whose unknown is the interface's velocity.
  std::vector<std::size_t> interface_displacements;
  /// The step's: du = dd / period for those entries. Their factors follow it.
  InterfaceKinematics interface;
  /// Raised when factors change: what was made of them is then out of date.
  int version = 0;

  /// Takes over the kinematics of a step. \returns whether factors have changed
  bool follow(const InterfaceKinematics& of_step) {
    const bool changed = interface.period != of_step.period;
    interface = of_step;
    if (!changed || (interface_velocities.empty() && interface_displacements.empty())) return false;
    for (std::size_t entry : interface_velocities) fluid[entry].factor = interface.rate();
    for (std::size_t entry : interface_displacements) mesh[entry].factor = interface.period;
    ++version;
    return true;
  }
};

}  // namespace fsi
