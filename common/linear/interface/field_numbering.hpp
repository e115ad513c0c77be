#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fem/unknowns.hpp"
#include "parallel/exchange.hpp"
#include "time/interface_kinematics.hpp"

namespace fsi {

/// Which entries of a Solution are unknowns of a system of equations, and which residual rows are its equations. Maps
/// of absent parts are empty. Single components of a node may be without an unknown, and so may its scalar.
///
/// Where a scene is shared out among processes, each has the equations of its nodes and their unknowns, 0 to size - 1.
/// Values at ghosts, copies of other processes' nodes, hang on these processes' unknowns: they are numbered on from `size`,
/// and have no equation here. Solutions hold both (columns()); the solver fills the first, update_ghosts() the rest.
struct Numbering {
  std::int64_t size = 0;             ///< equations, and unknowns, of this process
  std::int64_t first = 0;            ///< number among all processes' of the first of them: the others follow
  std::int64_t whole = 0;            ///< of all processes together; 0: not shared out
  std::vector<std::int64_t> ghosts;  ///< numbers among all processes' of the unknowns from `size` on
  Exchange exchange;                 ///< of unknowns
  const Communicator* processes = &Communicator::alone();

  std::size_t columns() const { return static_cast<std::size_t>(size) + ghosts.size(); }
  /// Of an unknown, own or ghost, among all processes'.
  std::int64_t global(std::int64_t unknown) const {
    return unknown < size ? first + unknown : ghosts[static_cast<std::size_t>(unknown - size)];
  }
  /// Gives the ghosts in x, of columns() numbers, their owners' values.
  void update_ghosts(std::vector<double>& x) const {
    if (!processes->is_alone()) exchange.update(x);
  }
  /// Unknowns of all processes.
  std::int64_t whole_size() const { return processes->is_alone() ? size : whole; }

  UnknownMap mesh_rows, mesh;    ///< mesh motion: equations, unknowns d_m; vector layout
  UnknownMap fluid_rows, fluid;  ///< momentum and continuity; (u, p_f); mixed layout
  UnknownMap wall_rows, wall;    ///< momentum and volume; (d_s, p_s); mixed layout

  /// What the system has where this process has none of it, be it for want of nodes: share_out() sets it.
  struct Elsewhere {
    bool mesh = false, fluid = false, wall = false, interface = false;
  };
  Elsewhere elsewhere;
  /// Whether the system has unknowns of a field, here or at another process: the same at all of them.
  bool has_mesh() const { return !mesh.empty() || elsewhere.mesh; }
  bool has_fluid() const { return !fluid.empty() || elsewhere.fluid; }
  bool has_wall() const { return !wall.empty() || elsewhere.wall; }

  /// Entries of `fluid` whose unknown is the interface's displacement.
  std::vector<std::size_t> interface_velocities;
  /// Entries of `mesh` whose unknown is the interface's velocity.
  std::vector<std::size_t> interface_displacements;
  /// The step's: du = dd / period for those entries. Their factors follow it.
  InterfaceKinematics interface;
  /// Raised when factors change: what was made of them is then out of date.
  int version = 0;

  /// Takes over the kinematics of a step. \returns whether factors have changed, here or at another process
  bool follow(const InterfaceKinematics& of_step) {
    const bool changed = interface.period != of_step.period;
    interface = of_step;
    const bool here = !interface_velocities.empty() || !interface_displacements.empty();
    if (!changed || (!here && !elsewhere.interface)) return false;
    for (std::size_t entry : interface_velocities) fluid[entry].factor = interface.rate();
    for (std::size_t entry : interface_displacements) mesh[entry].factor = interface.period;
    ++version;
    return true;
  }
};

}  // namespace fsi
