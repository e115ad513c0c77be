#include "linear/distributed/petsc_factories.hpp"

#include "fem/dimensions.hpp"
#ifdef FSI_WITH_MPI
#include "linear/distributed/petsc_direct_solver.hpp"
#include "linear/distributed/petsc_solver.hpp"
#else
#include "base/error.hpp"
#include "linear/distributed/petsc_options.hpp"
#endif

namespace fsi {

#ifdef FSI_WITH_MPI

bool has_petsc() {
  return true;
}

template <int n>
std::unique_ptr<LinearSolver> make_petsc_solver(const JacobianBlocks<n>& blocks, const FastOptions& fast) {
  return std::make_unique<PetscSolver<n>>(blocks, fast);
}

template <int n>
std::unique_ptr<LinearSolver> make_petsc_direct_solver(const JacobianBlocks<n>& blocks) {
  return std::make_unique<PetscDirectSolver<n>>(blocks);
}

#else

namespace {

[[noreturn]] void refuse_petsc() {
  throw InputError(case_of_petsc_options(), "linear_solver",
                   "\"petsc\" is not in this build, which is without MPI (FSI_MPI=OFF)",
                   "configure with -DFSI_MPI=ON and build again, or give \"fast\"");
}

}  // namespace

bool has_petsc() {
  return false;
}

template <int n>
std::unique_ptr<LinearSolver> make_petsc_solver(const JacobianBlocks<n>&, const FastOptions&) {
  refuse_petsc();
}

template <int n>
std::unique_ptr<LinearSolver> make_petsc_direct_solver(const JacobianBlocks<n>&) {
  refuse_petsc();
}

#endif

#define FSI_INSTANTIATE(n)                                                                                \
  template std::unique_ptr<LinearSolver> make_petsc_solver(const JacobianBlocks<n>&, const FastOptions&); \
  template std::unique_ptr<LinearSolver> make_petsc_direct_solver(const JacobianBlocks<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
