#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "run/command_line.hpp"

namespace fsi {

inline constexpr const char* linear_study_program = "fsi-linear-study";

/// A Newton system of a run: the k-th of a time step, both counted from 1.
struct NamedSystem {
  int step = 0, iteration = 0;
};

/// `--systems 1:1,12:2 --solvers lower,fast`: runs a three-dimensional case with fluid and wall up to the last named
/// Newton system. Each named system is solved with every named solver, and DIR/linear_solvers.json has iterations,
/// times, residuals and memory. Systems come from Newton's method with a new Jacobian in each iteration.
class LinearStudyRequest {
 public:
  std::vector<ExtraOption> options();
  /// \returns the exit code
  /// \throws InputError naming the option and the value that is wrong
  int run(const CommandLine& line, const Case& setup) const;

 private:
  std::string systems_, solvers_, tolerance_;
  bool sub_problems_ = false;
};

/// "1:1,12:2" as systems in the order of the run.
/// \throws InputError where an entry is not STEP:ITERATION with numbers from 1 on
std::vector<NamedSystem> parse_systems(const std::string& text);

}  // namespace fsi
