#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "system/numbering.hpp"

namespace fsi {

/// The Jacobian of a scene, or of one of its sub-problems, as its block matrices (boundary and interface conditions not
/// imposed) and the numbering that imposes them. A linear solver is made for one of these; the arrays keep their place,
/// their values change with each linearisation. Absent parts are null, and so are parts without unknowns.
template <class Element>
struct JacobianBlocks {
  static constexpr int n = Element::components;
  static constexpr int mixed = MixedLayout<n>::entries;

  const Scene<Element>& scene;
  const Numbering& numbering;
  const BlockMatrix<mixed, mixed>* flow = nullptr;           ///< d(momentum, continuity) / d(u, p_f)
  const BlockMatrix<mixed, n>* shape_derivatives = nullptr;  ///< d(momentum, continuity) / d(d_m)
  const MeshMotionMatrix<Element>* mesh = nullptr;           ///< Laplacian of the mesh motion, one number per component
  const BlockMatrix<mixed, mixed>* wall = nullptr;           ///< d(momentum, volume) / d(d_s, p_s)
};

/// What a linear solve did.
struct LinearReport {
  bool converged = true;
  int iterations = 0;            ///< Krylov or multigrid iterations; 0 for a direct solve
  double relative_residual = 0;  ///< true one, |b - J x| / |b|; 0 where a direct solver does not compute it
  std::string failure;           ///< why it stopped, when it did not converge
};

/// What a linear solver is made of, for reports.
struct LinearStatistics {
  double memory_mib = 0;           ///< matrices, factors and vectors that it holds beside the block matrices
  double operator_complexity = 0;  ///< entries of all levels over entries of the finest; 0 without levels
  int levels = 0;
  long long mesh_cycles = 0, flow_cycles = 0, wall_cycles = 0;  ///< sub-problem cycles so far
};

/// Solves J x = b for the Jacobian that a JacobianBlocks describes, in the unknowns of its numbering.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// The block matrices hold new values: prepare for solving with them.
  /// \throws ConvergenceError when the matrix is singular to working precision
  virtual void update() = 0;
  /// What update() is called in the profile.
  virtual const char* preparation() const { return "set-up"; }
  /// update() has been called.
  virtual bool ready() const = 0;
  /// \param tolerance  demanded |b - J x| / |b|; direct solvers solve to rounding
  /// \param x          overwritten
  virtual LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) = 0;
  virtual LinearStatistics statistics() const { return {}; }
  /// How much an iteration of Newton's method with a kept Jacobian must contract the residual for keeping it to pay: a
  /// matter of what update() costs beside solve(). By measurement (docs/performance.md, docs/solvers.md).
  virtual double keep_contraction() const { return 0.15; }
};

/// Makes the solver of one System.
template <class Element>
using LinearSolverFactory = std::function<std::unique_ptr<LinearSolver>(const JacobianBlocks<Element>&)>;

}  // namespace fsi
