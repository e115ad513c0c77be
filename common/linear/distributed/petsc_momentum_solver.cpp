#include "linear/distributed/petsc_momentum_solver.hpp"

#include "fem/dimensions.hpp"
#include "linear/distributed/petsc_options.hpp"

namespace fsi {

namespace {
constexpr const char* options_prefix = "fsi_velocity_";
}

template <int n>
struct PetscMomentumSolver<n>::WallLevels {
  bool smoothed;
  std::unique_ptr<typename VelocityPressureSystem<n>::WallMomentum> momentum;
  OwnedKsp solver;
  OwnedVec x, y;
};

template <int n>
PetscMomentumSolver<n>::PetscMomentumSolver(VelocityPressureSystem<n>& system)
    : system_(system), by_petsc_(has_petsc_options(options_prefix)) {}

template <int n>
void PetscMomentumSolver<n>::set_up(const BlockPreconditionerChoices& choices) {
  const double stiffness = system_.diagonals().stiffness();
  const bool wall_levels = choices.has_coarse_levels(stiffness);
  system_.products().set_up(choices, stiffness);
  if (!wall_levels) wall_.reset();
  if (!wall_levels && !by_petsc_) {
    solver_.reset();
    return;
  }
  if (!solver_ || around_wall_ != wall_levels) make_sweeps(wall_levels);
  if (wall_levels) set_up_wall(choices.smooths_aggregates(stiffness));
  for (PC sweep : sweeps_) {
    PetscBool is_sweep = PETSC_FALSE;
    petsc_check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(sweep), PCSOR, &is_sweep));
    PetscBool set = PETSC_FALSE;
    petsc_check(PetscOptionsHasName(nullptr, options_prefix, "-pc_sor_its", &set));
    if (is_sweep && !set) petsc_check(PCSORSetIterations(sweep, choices.momentum_sweeps, 1));
  }
  petsc_check(KSPSetOperators(solver_, system_.momentum(), system_.momentum()));
  petsc_check(KSPSetUp(solver_));
}

template <int n>
void PetscMomentumSolver<n>::make_sweeps(bool wall_levels) {
  around_wall_ = wall_levels;
  sweeps_.clear();
  petsc_check(KSPCreate(system_.communicator(), solver_.fresh()));
  petsc_check(KSPSetOptionsPrefix(solver_, options_prefix));
  petsc_check(KSPSetType(solver_, KSPPREONLY));
  petsc_check(KSPSetOperators(solver_, system_.momentum(), system_.momentum()));
  PC pc = nullptr;
  petsc_check(KSPGetPC(solver_, &pc));
  if (!wall_levels) {
    make_sweep(pc);
    petsc_check(KSPSetFromOptions(solver_));
    sweeps_ = {pc};
    return;
  }
  petsc_check(PCSetType(pc, PCCOMPOSITE));
  petsc_check(PCCompositeSetType(pc, PC_COMPOSITE_MULTIPLICATIVE));
  const char* const sweep = by_petsc_ ? PCSOR : PCSHELL;
  for (const char* type : {sweep, PCSHELL, sweep}) petsc_check(PCCompositeAddPCType(pc, type));
  for (const PetscInt i : {0, 1, 2}) {
    PC part = nullptr;
    petsc_check(PCCompositeGetPC(pc, i, &part));
    if (i == 1) {
      petsc_check(PCShellSetContext(part, this));
      petsc_check(PCShellSetApply(part, apply_wall));
      continue;
    }
    make_sweep(part);
    petsc_check(PCSetOptionsPrefix(part, options_prefix));
    petsc_check(PCSetFromOptions(part));
    sweeps_.push_back(part);
  }
}

template <int n>
void PetscMomentumSolver<n>::make_sweep(PC pc) {
  if (by_petsc_) {
    petsc_check(PCSetType(pc, PCSOR));
    petsc_check(PCSORSetSymmetric(pc, SOR_LOCAL_SYMMETRIC_SWEEP));
    return;
  }
  petsc_check(PCSetType(pc, PCSHELL));
  petsc_check(PCShellSetContext(pc, &system_.products()));
  petsc_check(PCShellSetApply(pc, apply_sweeps));
  petsc_check(PCShellSetName(pc, "symmetric Gauss-Seidel within each process, single precision"));
}

template <int n>
PetscErrorCode PetscMomentumSolver<n>::apply_sweeps(PC shell, Vec x, Vec y) {
  void* context = nullptr;
  if (const auto code = PCShellGetContext(shell, &context); code != 0) return code;
  static_cast<SharedProducts<n>*>(context)->sweep(x, y);
  return 0;
}

template <int n>
void PetscMomentumSolver<n>::set_up_wall(bool smoothed) {
  if (wall_ && wall_->smoothed != smoothed) wall_.reset();
  const bool first = wall_ == nullptr;
  if (first) {
    wall_ = std::make_shared<WallLevels>();
    wall_->smoothed = smoothed;
    wall_->momentum = system_.make_wall_momentum();
    const auto size = static_cast<PetscInt>(wall_->momentum->own.size() * n);
    wall_->x = petsc_vector(system_.communicator(), size);
    wall_->y = petsc_vector(system_.communicator(), size);
  }
  system_.fill_wall_momentum(*wall_->momentum);
  Mat matrix = wall_->momentum->matrix;
  if (first) {
    OwnedVec places;
    petsc_check(MatCreateVecs(matrix, places.fresh(), nullptr));
    petsc_check(VecSetBlockSize(places, n));
    double* to = nullptr;
    petsc_check(VecGetArray(places, &to));
    for (const auto& point : wall_->momentum->points)
      for (int k = 0; k < n; ++k) *to++ = point[k];
    to -= wall_->momentum->points.size() * n;
    petsc_check(VecRestoreArray(places, &to));
    MatNullSpace rigid = nullptr;
    petsc_check(MatNullSpaceCreateRigidBody(places, &rigid));
    petsc_check(MatSetNearNullSpace(matrix, rigid));
    petsc_check(MatNullSpaceDestroy(&rigid));
    petsc_check(KSPCreate(system_.communicator(), wall_->solver.fresh()));
    petsc_check(KSPSetOptionsPrefix(wall_->solver, prefix_of(PetscPart::wall)));
    petsc_check(KSPSetType(wall_->solver, KSPPREONLY));
    PC pc = nullptr;
    petsc_check(KSPGetPC(wall_->solver, &pc));
    petsc_check(PCSetType(pc, PCGAMG));
    // Aggregates are of the pattern and the places at rest alone, the same for all Jacobians of a run and after a
    // restart; as long as their rigid motions are not smoothed, by the matrix, so is the interpolation.
    PetscReal no_threshold = -1;
    petsc_check(PCGAMGSetThreshold(pc, &no_threshold, 1));
    petsc_check(PCGAMGSetNSmooths(pc, smoothed ? 1 : 0));
    petsc_check(PCGAMGSetReuseInterpolation(pc, smoothed ? PETSC_FALSE : PETSC_TRUE));
  }
  petsc_check(KSPSetOperators(wall_->solver, matrix, matrix));
  if (first) petsc_check(KSPSetFromOptions(wall_->solver));
  petsc_check(KSPSetUp(wall_->solver));
  if (first) refuse_unread_petsc_options(PetscPart::wall);
}

template <int n>
PetscErrorCode PetscMomentumSolver<n>::apply_wall(PC shell, Vec x, Vec y) {
  void* context = nullptr;
  if (const auto code = PCShellGetContext(shell, &context); code != 0) return code;
  WallLevels& wall = *static_cast<PetscMomentumSolver*>(context)->wall_;
  const auto& own = wall.momentum->own;
  const double *from = nullptr, *found = nullptr;
  double* to = nullptr;
  PetscErrorCode code = VecGetArrayRead(x, &from);
  if (code == 0) code = VecGetArrayWrite(wall.x, &to);
  if (code != 0) return code;
  for (std::size_t i = 0; i < own.size(); ++i)
    for (int k = 0; k < n; ++k) to[i * n + k] = from[static_cast<std::size_t>(own[i]) * n + k];
  code = VecRestoreArrayWrite(wall.x, &to);
  if (code == 0) code = VecRestoreArrayRead(x, &from);
  if (code == 0) code = KSPSolve(wall.solver, wall.x, wall.y);
  if (code == 0) code = VecSet(y, 0);
  if (code == 0) code = VecGetArrayRead(wall.y, &found);
  if (code == 0) code = VecGetArray(y, &to);
  if (code != 0) return code;
  for (std::size_t i = 0; i < own.size(); ++i)
    for (int k = 0; k < n; ++k) to[static_cast<std::size_t>(own[i]) * n + k] = found[i * n + k];
  code = VecRestoreArray(y, &to);
  return code != 0 ? code : VecRestoreArrayRead(wall.y, &found);
}

template <int n>
void PetscMomentumSolver<n>::apply(Vec residual, Vec velocities) {
  if (!solver_)
    system_.products().sweep(residual, velocities);
  else
    petsc_check(KSPSolve(solver_, residual, velocities));
}

#define FSI_INSTANTIATE(n) template class PetscMomentumSolver<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
