#include "linear/distributed/petsc_solver.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "linear/direct/direct_solver.hpp"
#include "linear/distributed/mesh_extensions.hpp"
#include "linear/distributed/petsc_direct_solver.hpp"
#include "linear/distributed/petsc_momentum_solver.hpp"
#include "linear/distributed/petsc_options.hpp"
#include "linear/distributed/velocity_pressure_system.hpp"
#include "linear/interface/linear_attempts.hpp"
#include "linear/krylov/gmres.hpp"
#include "linear/policy/solver_policy.hpp"
#include "linear/velocity_pressure/condensed_iteration.hpp"

namespace fsi {

template <int n>
struct PetscSolver<n>::Iterative {
  VelocityPressureLayout<n> layout;
  VelocityPressureSystem<n> system;
  PetscMomentumSolver<n> momentum;
  CondensedIteration<n> iteration;
  OwnedMat whole;  ///< F
  OwnedKsp krylov, pressure;
  OwnedVec b, x, pressure_residual, velocity_residual;
  OwnedVec in_velocities, in_pressures, out_velocities, out_pressures;  ///< of the preconditioner's vectors

  Iterative(const JacobianBlocks<n>& blocks, const FastOptions& options)
      : layout(blocks),
        system(blocks, layout),
        momentum(system),
        iteration(blocks, layout, make_shared_extension<n>, options.max_iterations),
        b(petsc_vector(system.communicator(), system.shared().rows())),
        x(petsc_vector(system.communicator(), system.shared().rows())),
        pressure_residual(petsc_vector(system.communicator(), system.shared().pressure_rows)),
        velocity_residual(petsc_vector(system.communicator(), system.shared().velocity_rows)),
        in_velocities(system.velocity_view()),
        in_pressures(system.pressure_view()),
        out_velocities(system.velocity_view()),
        out_pressures(system.pressure_view()) {
    take_petsc_options();
    make_krylov(options);
    make_pressure_solver();
  }

  void make_krylov(const FastOptions& options) {
    const PetscInt rows = system.shared().rows();
    petsc_check(
        MatCreateShell(system.communicator(), rows, rows, PETSC_DETERMINE, PETSC_DETERMINE, this, whole.fresh()));
    petsc_check(MatShellSetOperation(whole, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
    petsc_check(KSPCreate(system.communicator(), krylov.fresh()));
    petsc_check(KSPSetOptionsPrefix(krylov, prefix_of(PetscPart::flow)));
    petsc_check(KSPSetType(krylov, KSPFGMRES));
    petsc_check(KSPGMRESSetRestart(krylov, options.restart));
    petsc_check(KSPSetOperators(krylov, whole, whole));
    PC pc = nullptr;
    petsc_check(KSPGetPC(krylov, &pc));
    petsc_check(PCSetType(pc, PCSHELL));
    petsc_check(PCShellSetContext(pc, this));
    petsc_check(PCShellSetApply(pc, precondition));
    petsc_check(PCShellSetName(pc, "block factors, velocities and pressures"));
    petsc_check(KSPSetFromOptions(krylov));
  }

  void make_pressure_solver() {
    constexpr const char* prefix = "fsi_pressure_";
    petsc_check(KSPCreate(system.communicator(), pressure.fresh()));
    petsc_check(KSPSetOptionsPrefix(pressure, prefix));
    petsc_check(KSPSetType(pressure, KSPPREONLY));
    PC pc = nullptr;
    petsc_check(KSPGetPC(pressure, &pc));
    const SolverPolicy policy(SolvedSystem::shared_schur_complement, n, {std::nullopt, has_petsc_options(prefix)});
    if (!policy.decide(static_cast<std::int64_t>(system.shared().whole_pressures)).iterates) {
      factorise_by_each(pc);
      return;
    }
    // By measurement: half the seconds of BoomerAMG (docs/guide/solvers.md).
    petsc_check(PCSetType(pc, PCGAMG));
    petsc_check(PCGAMGSetCoarseEqLim(pc, 400));
    petsc_check(PCGAMGSetReuseInterpolation(pc, PETSC_FALSE));  // a restart could not
    petsc_check(KSPSetFromOptions(pressure));
  }

  /// Every process has all of the matrix.
  static void factorise_by_each(PC pc) {
    petsc_check(PCSetType(pc, PCREDUNDANT));
    KSP whole = nullptr;
    petsc_check(PCRedundantGetKSP(pc, &whole));
    petsc_check(KSPSetType(whole, KSPPREONLY));
    petsc_check(KSPGetPC(whole, &pc));
    petsc_check(PCSetType(pc, PCCHOLESKY));  // S is symmetric but for convection
    petsc_check(PCFactorSetShiftType(pc, MAT_SHIFT_INBLOCKS));
  }

  void set_up(const BlockPreconditionerChoices& choices) {
    momentum.set_up(choices);
    system.make_schur_complement(
        choices.wall_diagonal_factor(system.diagonals().stiffness(), system.has_few_pressures()));
    petsc_check(KSPSetOperators(pressure, system.schur(), system.schur()));
    petsc_check(KSPSetUp(pressure));
  }

  static PetscErrorCode multiply(Mat shell, Vec in, Vec out) {
    void* context = nullptr;
    if (const auto code = MatShellGetContext(shell, &context); code != 0) return code;
    return guarded([&] { static_cast<Iterative*>(context)->system.products().multiply(in, out); });
  }

  static PetscErrorCode precondition(PC shell, Vec in, Vec out) {
    void* context = nullptr;
    if (const auto code = PCShellGetContext(shell, &context); code != 0) return code;
    return guarded([&] { static_cast<Iterative*>(context)->apply_inverse(in, out); });
  }

  void apply_inverse(Vec in, Vec out) {
    using Parts = typename VelocityPressureSystem<n>::Parts;
    const Parts of_in(system, in_velocities, in_pressures, in, false),
        of_out(system, out_velocities, out_pressures, out, true);
    system.reduce(in, pressure_residual);
    petsc_check(KSPSolve(pressure, pressure_residual, out_pressures));
    petsc_check(VecCopy(in_velocities, velocity_residual));
    system.products().subtract_gradient(out_pressures, velocity_residual);
    momentum.apply(velocity_residual, out_velocities);
  }

  /// solution = approximate F^-1 right, see CondensedIteration.
  typename CondensedIteration<n>::InnerReport solve(const std::vector<double>& right, double norm_of_right,
                                                    double tolerance, std::vector<double>& solution) {
    tolerance = std::max(tolerance, SingleGmres::smallest_tolerance);  // the products' precision
    const auto& shared = system.shared();
    double* to = nullptr;
    petsc_check(VecGetArrayWrite(b, &to));
    for (const int v : shared.own_velocities) to = std::copy_n(right.data() + VectorLayout<n>::vector(v), n, to);
    for (const int p : shared.own_pressures) *to++ = right[layout.velocity_size() + p];
    to -= shared.rows();
    petsc_check(VecRestoreArrayWrite(b, &to));
    petsc_check(KSPSetTolerances(krylov, tolerance, 1e-300, PETSC_DEFAULT, restart()));
    petsc_check(KSPSolve(krylov, b, x));
    PetscInt iterations = 0;
    petsc_check(KSPGetIterationNumber(krylov, &iterations));
    const double* from = nullptr;
    petsc_check(VecGetArrayRead(x, &from));
    const double* at = from;
    for (const int v : shared.own_velocities) {
      std::copy_n(at, n, solution.data() + VectorLayout<n>::vector(v));
      at += n;
    }
    for (const int p : shared.own_pressures) solution[layout.velocity_size() + p] = *at++;
    petsc_check(VecRestoreArrayRead(x, &from));
    typename CondensedIteration<n>::InnerReport report;
    report.iterations = static_cast<int>(iterations);
    KSPNormType norm = KSP_NORM_NONE;  // options of PETSc may have chosen another method
    petsc_check(KSPGetNormType(krylov, &norm));
    if (norm != KSP_NORM_UNPRECONDITIONED) return report;
    PetscReal left = 0;
    petsc_check(KSPGetResidualNorm(krylov, &left));
    report.relative_residual = (left + system.products().rounding(x)) / norm_of_right;
    return report;
  }

  PetscInt restart() const {
    PetscInt count = 0;
    petsc_check(KSPGMRESGetRestart(krylov, &count));
    return count > 0 ? count : FastOptions().restart;  // of another method
  }

  /// PETSc is C: exceptions stay on this side.
  template <class Work>
  static PetscErrorCode guarded(Work work) {
    try {
      work();
    } catch (const std::exception& failure) {
      return PetscError(PETSC_COMM_SELF, __LINE__, "guarded", __FILE__, PETSC_ERR_LIB, PETSC_ERROR_INITIAL, "%s",
                        failure.what());
    }
    return 0;
  }
};

template <int n>
PetscSolver<n>::PetscSolver(const JacobianBlocks<n>& blocks, const FastOptions& options)
    : blocks_(blocks), options_(options) {}

template <int n>
PetscSolver<n>::~PetscSolver() = default;

template <int n>
void PetscSolver<n>::update() {
  const OneDenseThread same_bits_for_any_number;
  direct_.reset();
  const bool first = !iterative_;
  try {
    if (first) iterative_ = std::make_unique<Iterative>(blocks_, options_);
    iterative_->iteration.update();
    iterative_->layout.update();
    iterative_->system.fill();
    set_up_preconditioner(false);
  } catch (const PetscFailure& failure) {
    if (first && has_petsc_options()) blame_petsc_options(failure.what());
    throw ConvergenceError(failure.what(), "a smaller time step, or linear_solver = \"direct\"");
  }
  if (first) refuse_unread_petsc_options(PetscPart::flow);
  ready_ = true;
}

template <int n>
void PetscSolver<n>::set_up_preconditioner(bool strong) {
  BlockPreconditionerChoices choices;
  choices.momentum_sweeps = strong ? options_.strong_sweeps : options_.momentum_sweeps;
  if (strong) choices.coarse_from = 0;
  iterative_->set_up(choices);
  strengthened_ = strong;
}

template <int n>
LinearReport PetscSolver<n>::solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) {
  return solve(b, tolerance, x, true);
}

template <int n>
LinearReport PetscSolver<n>::try_to_solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) {
  return solve(b, tolerance, x, false);
}

template <int n>
LinearReport PetscSolver<n>::solve(const std::vector<double>& b, double tolerance, std::vector<double>& x,
                                   bool may_factorise) {
  const OneDenseThread same_bits_for_any_number;
  if (direct_) return direct_->solve(b, tolerance, x);
  const auto inner = [&](const std::vector<double>& right, double scale, double wanted, std::vector<double>& solution) {
    return iterative_->solve(right, scale, wanted, solution);
  };
  LinearAttempts attempts;
  attempts.profile = blocks_.profile;
  attempts.iterate = [&] {
    return iterative_->iteration.solve(b, tolerance, inner, x, &iterative_->system.products().shape_derivatives());
  };
  attempts.strengthen = [&] { set_up_preconditioner(true); };
  attempts.strengthenings = strengthened_ ? 0 : SolverPolicy(SolvedSystem::jacobian, n).strengthenings();
  if (may_factorise)
    attempts.factorise = [&] {
      direct_ = std::make_unique<PetscDirectSolver<n>>(blocks_);
      direct_->update();
      return direct_->solve(b, tolerance, x);
    };
  return attempts.run();
}

template <int n>
double PetscSolver<n>::keep_contraction() const {
  return direct_ ? direct_->keep_contraction() : LinearSolver::keep_contraction();
}

template <int n>
LinearStatistics PetscSolver<n>::statistics() const {
  LinearStatistics s;
  if (direct_) s = direct_->statistics();
  if (!iterative_) return s;
  s.memory_mib += iterative_->system.bytes() / (1 << 20);
  if (const auto* extension = iterative_->iteration.extension()) s.memory_mib += extension->memory_mib();
  return s;
}

#define FSI_INSTANTIATE(n) template class PetscSolver<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
