#pragma once

#include <vector>

#include "linear/distributed/shared_layout.hpp"
#include "linear/velocity_pressure/block_preconditioner_choices.hpp"
#include "linear/velocity_pressure/momentum_diagonals.hpp"
#include "linear/velocity_pressure/momentum_sweep.hpp"
#include "linear/velocity_pressure/velocity_pressure_matrix.hpp"

namespace fsi {

/// What `fast` does with F = [A G; B C], in single precision, on vectors that processes share: each has the rows of its own
/// velocities and pressures, and is sent the others' values that these ask for. PETSc's products and sweeps in double
/// precision take several times as long (docs/archive.md).
template <int n>
class SharedProducts {
 public:
  SharedProducts(const JacobianBlocks<n>& blocks, const VelocityPressureLayout<n>& layout,
                 const SharedLayout<n>& shared, MPI_Comm communicator);

  /// Takes the present values of the blocks and sets `diagonals` to theirs.
  void fill(MomentumDiagonals<n>& diagonals, bool few_pressures, const Communicator& processes);
  /// Sets number and relaxation of the sweeps. \param stiffness  MomentumDiagonals::stiffness()
  void set_up(const BlockPreconditionerChoices& choices, double stiffness);

  /// y = F x, in the rows of SharedLayout.
  void multiply(Vec x, Vec y);
  /// pressures = B v of the velocities of x; what it holds of pressures does not count.
  void divergence(Vec x, Vec pressures);
  /// velocities -= G p
  void subtract_gradient(Vec pressures, Vec velocities);
  /// velocities = approximate A^-1 residual, by sweeps over A's columns of this process's own velocities
  void sweep(Vec residual, Vec velocities);

  /// VelocityPressureMatrix::rounding() of the velocities of x: one norm over all processes.
  /// \param x  in the rows of SharedLayout
  double rounding(Vec x);
  const InterfaceShapeDerivatives<n>& shape_derivatives() const { return matrix_.shape_derivatives(); }
  double bytes() const { return static_cast<double>(matrix_.bytes() + sweep_.bytes()); }

 private:
  static constexpr int lanes = padded<n>;

  /// Of those that others own: where their numbers come from and go to.
  struct Ghosts {
    OwnedScatter scatter;
    OwnedVec received;
    std::vector<std::size_t> places;  ///< in `local_`
  };
  Ghosts make_ghosts(Vec pattern, const std::vector<PetscInt>& from, const std::vector<std::size_t>& places) const;
  /// local_ has the values of x that its owners have.
  void receive(Vec x, Ghosts& ghosts);
  void take_velocities(Vec x, std::vector<float>& to) const;
  void give_velocities(const std::vector<float>& from, double* to) const;

  const VelocityPressureLayout<n>& layout_;
  const SharedLayout<n>& shared_;
  VelocityPressureMatrix<n> matrix_;  ///< rows of others are empty
  MomentumSweep<n> sweep_;
  int sweeps_ = 1;
  Ghosts of_both_, of_pressures_;
  std::vector<float> local_, product_;              ///< velocities, then pressures, the others' too
  std::vector<float> residual_, velocity_, again_;  ///< velocities; those of others stay zero
};

}  // namespace fsi
