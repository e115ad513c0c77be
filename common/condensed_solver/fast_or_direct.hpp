#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "case/case.hpp"
#include "condensed_solver/fast_solver.hpp"
#include "system/direct_linear_solver.hpp"

namespace fsi {

/// A linear solver that serves any scene and any sub-problem.
template <int n>
struct GeneralSolver {
  std::string_view name;
  std::unique_ptr<LinearSolver> (*make)(const JacobianBlocks<n>& blocks, const FastOptions& fast);
};

template <int n>
inline constexpr std::array<GeneralSolver<n>, 2> general_solvers{
    {{"fast",
      [](const JacobianBlocks<n>& blocks, const FastOptions& fast) -> std::unique_ptr<LinearSolver> {
        return std::make_unique<FastSolver<n>>(blocks, fast);
      }},
     {"direct", [](const JacobianBlocks<n>& blocks, const FastOptions&) -> std::unique_ptr<LinearSolver> {
        return std::make_unique<DirectLinearSolver<n>>(blocks);
      }}}};

/// Null when no such solver serves any scene.
template <int n>
const GeneralSolver<n>* find_general_solver(const std::string& name) {
  static_assert(names_match(general_solver_list, general_solvers<n>), "case/choices.hpp owns these names");
  for (const auto& solver : general_solvers<n>)
    if (solver.name == name) return &solver;
  return nullptr;
}

/// Factory of the linear solver `name`, one of general_solver_names().
/// \throws InputError for another name
template <int n>
LinearSolverFactory<n> general_solver_factory(const std::string& name, const FastOptions& fast) {
  const auto* solver = find_general_solver<n>(name);
  if (solver == nullptr) refuse_name("linear_solver", name, general_solver_names());
  return [make = solver->make, fast](const JacobianBlocks<n>& blocks) { return make(blocks, fast); };
}

/// As the case's [monolithic] asks, for a scene with fluid or wall only.
/// \throws InputError for a solver of coupled scenes
template <int n>
std::unique_ptr<LinearSolver> make_fast_or_direct(const std::string& name, const Case& setup,
                                                  const JacobianBlocks<n>& blocks) {
  const auto* solver = find_general_solver<n>(name);
  if (solver == nullptr)
    throw InputError(setup.path.string(), "monolithic.linear_solver",
                     "\"" + name + "\" is for scenes of fluid and wall", "give " + one_of(general_solver_names()));
  return solver->make(blocks, setup.monolithic.fast);
}

}  // namespace fsi
