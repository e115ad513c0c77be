#include "linear/choice/general_solvers.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "linear/distributed/mesh_extensions.hpp"
#include "linear/distributed/petsc_factories.hpp"
#include "linear/distributed/petsc_options.hpp"
#include "linear/interface/central_direct_solver.hpp"
#include "linear/interface/direct_linear_solver.hpp"
#include "linear/velocity_pressure/fast_solver.hpp"

namespace fsi {

void refuse_preconditioner(const FastOptions& fast, const std::string& where) {
  if (fast.preconditioner == flow_preconditioner_list[0]) return;
  throw InputError(case_of_petsc_options(), "linear.preconditioner",
                   "\"" + fast.preconditioner + "\" is a preconditioner of \"fast\", and there is none for " + where,
                   "leave it out, or take linear_solver = \"fast\" without [petsc] options");
}

namespace {

template <int n>
using Blocks = JacobianBlocks<n>;

/// On several processes options of PETSc are for `petsc`.
bool is_petsc_in_place_of_fast(const Communicator& processes) {
  return !processes.is_alone() && has_petsc_options();
}

template <int n>
FastParts<n> parts_on_processes() {
  FastParts<n> parts;
  parts.extension = make_shared_extension<n>;
  parts.factors = [](const Blocks<n>& blocks) { return std::make_unique<CentralDirectSolver<n>>(blocks); };
  parts.rescue = [](const Blocks<n>& blocks) { return make_petsc_direct_solver<n>(blocks); };
  return parts;
}

template <int n>
std::unique_ptr<LinearSolver> make_petsc(const Blocks<n>& blocks, const FastOptions& fast) {
  refuse_preconditioner(fast, "\"petsc\"");
  return make_petsc_solver<n>(blocks, fast);
}

template <int n>
std::unique_ptr<LinearSolver> make_fast(const Blocks<n>& blocks, const FastOptions& fast) {
  const Communicator& processes = *blocks.numbering.processes;
  if (processes.is_alone()) return std::make_unique<FastSolver<n>>(blocks, fast);
  if (is_petsc_in_place_of_fast(processes)) return make_petsc(blocks, fast);
  return std::make_unique<FastSolver<n>>(blocks, fast, JacobianPolicy<n>(blocks, fast), parts_on_processes<n>());
}

template <int n>
std::unique_ptr<LinearSolver> make_direct(const Blocks<n>& blocks, const FastOptions& fast) {
  refuse_preconditioner(fast, "\"direct\"");
  if (!blocks.numbering.processes->is_alone()) return make_petsc_direct_solver<n>(blocks);
  return std::make_unique<DirectLinearSolver<n>>(blocks);
}

/// A linear solver that serves any scene and any sub-problem.
template <int n>
struct GeneralSolver {
  std::string_view name;
  std::unique_ptr<LinearSolver> (*make)(const Blocks<n>& blocks, const FastOptions& fast);
};

template <int n>
constexpr std::array<GeneralSolver<n>, 3> general_solvers{
    {{"fast", make_fast<n>}, {"direct", make_direct<n>}, {"petsc", make_petsc<n>}}};

/// Null when no such solver serves any scene.
template <int n>
const GeneralSolver<n>* find_general_solver(const std::string& name) {
  static_assert(names_match(general_solver_list, general_solvers<n>), "case/choices.hpp owns these names");
  for (const auto& solver : general_solvers<n>)
    if (solver.name == name) return &solver;
  return nullptr;
}

}  // namespace

bool is_general_solver(const std::string& name) {
  return find_general_solver<3>(name) != nullptr;
}

template <int n>
std::unique_ptr<LinearSolver> make_general_solver(const std::string& name, const FastOptions& fast,
                                                  const JacobianBlocks<n>& blocks) {
  const auto* solver = find_general_solver<n>(name);
  if (solver == nullptr) refuse_name("linear_solver", name, general_solver_names());
  return solver->make(blocks, fast);
}

template <int n>
LinearSolverFactory<n> general_solver_factory(const std::string& name, const FastOptions& fast) {
  if (!is_general_solver(name)) refuse_name("linear_solver", name, general_solver_names());
  return [name, fast](const JacobianBlocks<n>& blocks) { return make_general_solver<n>(name, fast, blocks); };
}

template <int n>
std::unique_ptr<LinearSolver> make_fast_or_direct(const std::string& name, const Case& setup,
                                                  const JacobianBlocks<n>& blocks) {
  if (!is_general_solver(name))
    throw InputError(setup.path.string(), "monolithic.linear_solver",
                     "\"" + name + "\" is for scenes of fluid and wall", "give " + one_of(general_solver_names()));
  return make_general_solver<n>(name, setup.linear.fast, blocks);
}

std::string linear_solver_in_words(const std::string& name, const FastOptions& fast, const Communicator& processes) {
  if (name != "fast") return name;
  if (is_petsc_in_place_of_fast(processes)) return "petsc";
  return fmt::format("{}, where it iterates preconditioned by {}", name, fast.preconditioner);
}

std::string other_solver_on_processes(const std::string& name, const FastOptions& fast, int dimension,
                                      const Communicator& processes) {
  if (processes.is_alone()) return "";
  if (is_petsc_in_place_of_fast(processes) && name == "fast")
    return "linear_solver = \"petsc\" in place of \"fast\", since the case has [petsc] options";
  if (name == "fast") {
    const SolverPolicy policy(SolvedSystem::jacobian, dimension, {fast.direct_below, false, processes.size()});
    const auto bound = policy.factorises_below();
    if (bound > 0)
      return fmt::format(
          "linear_solver = \"fast\": systems below {} unknowns are factorised at the first process{}", bound,
          policy.wall_decides(bound - 1) ? fmt::format(", but for coupled ones from {} on that the wall decides about",
                                                       SolverPolicy::wall_decides_from)
                                         : "");
  }
  if (name == "direct") return "linear_solver = \"direct\" factorises by MUMPS, since UMFPACK works on one process";
  return "";
}

#define FSI_INSTANTIATE(n)                                                                           \
  template std::unique_ptr<LinearSolver> make_general_solver(const std::string&, const FastOptions&, \
                                                             const JacobianBlocks<n>&);              \
  template LinearSolverFactory<n> general_solver_factory(const std::string&, const FastOptions&);    \
  template std::unique_ptr<LinearSolver> make_fast_or_direct(const std::string&, const Case&, const JacobianBlocks<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
