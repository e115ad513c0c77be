#pragma once

#include <memory>
#include <string>

#include "base/error.hpp"
#include "case/case.hpp"
#include "condensed_solver/fast_solver.hpp"
#include "system/direct_linear_solver.hpp"

namespace fsi {

/// The linear solvers that serve any scene and any sub-problem, by name: `fast` and `direct`.
/// \throws InputError for another name: those are for scenes of fluid and wall in the monolithic driver
template <class Element>
std::unique_ptr<LinearSolver> make_fast_or_direct(const std::string& name, const Case& setup,
                                                  const JacobianBlocks<Element>& blocks) {
  if (name == "direct") return std::make_unique<DirectLinearSolver<Element>>(blocks);
  if (name != "fast")
    throw InputError(setup.path.string(), "monolithic.linear_solver",
                     "\"" + name + "\" is for scenes of fluid and wall", "give fast or direct");
  FastOptions options;
  options.direct_below = setup.monolithic.direct_below;
  return std::make_unique<FastSolver<Element>>(blocks, options);
}

}  // namespace fsi
