#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace fsi {

/// What is iterated or factorised. Its row in solver_policy.cpp says where factors are quicker.
enum class SolvedSystem {
  jacobian,                ///< of a scene or a medium; its size counts unknowns of all processes
  harmonic_mesh_motion,    ///< its size counts inner nodes without followers, of the process with the most of them
  tangent_mesh_motion,     ///< the same of a nonlinear motion; inner nodes
  shared_mesh_motion,      ///< by PETSc, or at the first process; unknowns
  schur_complement,        ///< of the pressures, in the preconditioner of `fast` on one process; pressures
  shared_schur_complement  ///< the same on several processes, and in that of `petsc`
};

struct SolverDecision {
  bool iterates = false;
  std::string reason;  ///< a clause for the log
};

/// Whether a linear system is iterated or factorised, on any number of processes, in two and three dimensions, and what
/// is done where that fails. Decided by the system's size, by what the case demands, and for coupled systems of the plane
/// by their wall, never by measured seconds or free memory: so a restart decides the same.
class SolverPolicy {
 public:
  struct Demands {
    std::optional<std::int64_t> factorise_below;  ///< in place of standard_limit()
    bool options_of_iteration = false;            ///< the case has [petsc] options, which are for an iteration
    int processes = 1;                            ///< factors are then at the first
  };

  /// \param dimension  of the scene: 2 or 3
  SolverPolicy(SolvedSystem system, int dimension);
  SolverPolicy(SolvedSystem system, int dimension, Demands demands);

  /// Sizes below which a sparse factorisation is quicker.
  static std::int64_t standard_limit(SolvedSystem system, int dimension);
  /// Sizes below which this system is factorised.
  std::int64_t factorises_below() const;
  /// \param size  of what SolvedSystem says that this system counts
  SolverDecision decide(std::int64_t size) const;

  /// In two dimensions a coupled Jacobian of `wall_decides_from` unknowns or more is iterated all the same where its wall's
  /// stiffness over inertia is less than `wall_iterates_below`: without the seconds and the memory of factors, which a run
  /// has to earn back by quicker solves (at a ratio of 2.7 not in 200 steps, at 5.3 in 150, at 9 in 50).
  static constexpr std::int64_t wall_decides_from = 10000;
  static constexpr double wall_iterates_below = 4;
  /// decide_by_wall(), not decide(), holds for a coupled Jacobian of this size.
  bool wall_decides(std::int64_t size) const;
  /// \param stiffness_over_inertia  MomentumDiagonals::stiffness(), without unit
  SolverDecision decide_by_wall(double stiffness_over_inertia) const;
  /// For the log: a clause on what decide_by_wall() does.
  static std::string rule_of_wall();

  /// How often an iteration that fails is repeated with a stronger preconditioner.
  int strengthenings() const;

 private:
  SolvedSystem system_;
  int dimension_;
  Demands demands_;
};

}  // namespace fsi
