#pragma once

#include <cstdint>
#include <vector>

#include "linear/distributed/petsc_call.hpp"
#include "linear/velocity_pressure/velocity_pressure_ghosts.hpp"

namespace fsi {

/// The velocities and pressures of a layout among those of all processes. Each process has rows for its own: n for each
/// velocity node, then one for each pressure.
template <int n>
class SharedLayout {
 public:
  /// \throws InputError when there are more of them than PETSc can count
  SharedLayout(const JacobianBlocks<n>& blocks, const VelocityPressureLayout<n>& layout);

  std::vector<int> own_velocities, own_pressures;        ///< in the layout's numbers, ascending
  std::vector<char> owns_velocity, owns_pressure;        ///< per velocity, pressure of the layout
  std::vector<PetscInt> velocity_number;                 ///< per velocity, among all velocity nodes
  std::vector<PetscInt> pressure_number;                 ///< per pressure, among all pressures
  std::vector<PetscInt> velocity_place, pressure_place;  ///< in the rows of both, of the first component
  double whole_velocities = 0, whole_pressures = 0;      ///< of all processes
  PetscInt velocity_rows = 0, pressure_rows = 0;         ///< of this process
  PetscInt first_velocity = 0;                           ///< number of its first velocity node

  /// Gives ghosts' velocities the owners' numbers. \param per_velocity  of the layout
  void update_velocities(std::vector<double>& per_velocity) const { ghosts_.velocities.exchange.update(per_velocity); }

  PetscInt rows() const { return velocity_rows + pressure_rows; }

 private:
  VelocityPressureGhosts<n> ghosts_;
};

}  // namespace fsi
