#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "base/profile.hpp"
#include "fem/nodal_frames.hpp"
#include "fem/nodal_layout.hpp"
#include "linear/interface/field_numbering.hpp"
#include "linear/interface/medium_preconditioner.hpp"
#include "mesh/submesh.hpp"

namespace fsi {

/// A node of the interface in the numbers of both parts.
struct InterfacePair {
  int fluid, wall;
};

/// The Jacobian of a scene, or of one of its sub-problems, as its block matrices (boundary and interface conditions not
/// imposed) and the numbering that imposes them: all that a linear solver sees of a scene. A solver is made for one of
/// these; the arrays keep their place, their values change with each linearisation. Absent parts are null, and so are
/// parts without unknowns. Where the scene is shared out, all processes call its solver together, and rows of ghosts are
/// incomplete: they have no equation in the numbering.
template <int n>
struct JacobianBlocks {
  static constexpr int mixed = MixedLayout<n>::entries;

  /// Its factors and its interface's kinematics hold for the values that update() finds, and may differ at the next.
  const Numbering& numbering;
  const BlockMatrix<mixed, mixed>* fluid = nullptr;          ///< d(momentum, continuity) / d(u, p_f)
  const BlockMatrix<mixed, n>* shape_derivatives = nullptr;  ///< d(momentum, continuity) / d(d_m)
  const BlockMatrix<1, n>* mesh_laplacian = nullptr;         ///< of the mesh motion, one number per component
  const BlockMatrix<n, n>* mesh_tangent = nullptr;           ///< in its place, of a mesh motion that is not linear
  const BlockMatrix<mixed, mixed>* wall = nullptr;           ///< d(momentum, volume) / d(d_s, p_s)
  /// Nodes whose components of vectors are those of a frame, in all blocks but those of the mesh motion; null: none.
  const NodalFrames<n>* fluid_frames = nullptr;
  const NodalFrames<n>* wall_frames = nullptr;
  const PartNodes* fluid_nodes = nullptr;
  const PartNodes* wall_nodes = nullptr;
  const std::vector<InterfacePair>* interface = nullptr;  ///< all of it, clamped nodes too; null for one part alone
  /// How often the mesh motion's operator was assembled: what is made of it is as old as the count it was made at.
  const int* mesh_laplacian_version = nullptr;
  Profile* profile = nullptr;  ///< of the run; null: nothing is counted

  /// d = wall_factor v ties changes of the wall's displacement and of its velocity; 1 in statics.
  double wall_factor() const { return numbering.interface.period; }
  bool coupled() const { return fluid && wall && mesh_laplacian && interface; }
};

/// What a linear solve did.
struct LinearReport {
  bool converged = true;
  int iterations = 0;            ///< Krylov or multigrid iterations; 0 for a direct solve
  double relative_residual = 0;  ///< |b - J x| / |b|, or a bound of it; 0: not computed, since factors solved
  std::string failure;           ///< why it stopped, when it did not converge
};

/// What a linear solver is made of, for reports.
struct LinearStatistics {
  double memory_mib = 0;           ///< matrices, factors and vectors that it holds beside the block matrices
  double operator_complexity = 0;  ///< entries of all levels over entries of the finest; 0 without levels
  int levels = 0;
  long long mesh_cycles = 0, fluid_cycles = 0, wall_cycles = 0;  ///< sub-problem cycles so far
};

/// Solves J x = b for the Jacobian that a JacobianBlocks describes, in the unknowns of its numbering.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// The block matrices hold new values: prepare for solving with them.
  /// \throws ConvergenceError when the matrix is singular to working precision, OutOfMemory when factors do not fit,
  ///         InputError for [petsc] options that PETSc does not take
  virtual void update() = 0;
  /// The profile's name for update() with the values that the blocks now hold.
  virtual const char* preparation() { return "set-up"; }
  /// For the log: a clause on what the solver decides anew for each Jacobian, by its values; empty: nothing.
  virtual std::string decides() const { return ""; }
  /// update() has been called.
  virtual bool ready() const = 0;
  /// \param b          Numbering::size entries, of this process's equations
  /// \param tolerance  demanded |b - J x| / |b|; direct solvers solve to rounding
  /// \param x          overwritten: Numbering::columns() entries; those of ghosts are the caller's to update
  /// \throws ConvergenceError by factors of a matrix that turns out to be singular to working precision
  virtual LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) = 0;
  /// Like solve(), but an iteration that fails never falls back to a factorisation; for callers with a fallback of their own.
  virtual LinearReport try_to_solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) {
    return solve(b, tolerance, x);
  }
  virtual LinearStatistics statistics() const { return {}; }
  /// How much an iteration of Newton's method with a kept Jacobian must contract the residual for keeping it to pay: a
  /// matter of what update() costs beside solve(). By measurement (docs/archive.md, docs/guide/solvers.md).
  virtual double keep_contraction() const { return 0.3; }
  /// What the solver iterates with, as of the last update(); null where it does not.
  virtual MediumPreconditioner* medium_preconditioner() { return nullptr; }
  /// The solver is set up to iterate. True also where the present Jacobian defeated the iteration and is factorised.
  virtual bool is_iterative() const { return false; }
};

/// Makes the solver of one System.
template <int n>
using LinearSolverFactory = std::function<std::unique_ptr<LinearSolver>(const JacobianBlocks<n>&)>;

}  // namespace fsi
