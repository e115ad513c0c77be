#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/driver.hpp"

namespace fsi {

/// A Newton system of a run: the k-th of a time step, both counted from 1.
struct NamedSystem {
  int step = 0, iteration = 0;
};

/// `--linear-systems 1:1,12:2 --linear-solvers lower,fast`: in place of a run, its time steps up to the last named
/// Newton system; each of these is solved with every named solver, and DIR/linear_solvers.json tells iterations, times,
/// residuals and memory. Systems come from Newton's method with a new Jacobian in each iteration.
class LinearStudyRequest {
 public:
  std::vector<ExtraOption> options();
  /// \throws InputError naming the option and the value that is wrong
  std::optional<int> run(const CommandLine& line, const Case& setup) const;

 private:
  std::string systems_, solvers_, tolerance_;
  bool sub_problems_ = false;
};

/// "1:1,12:2" as systems in the order of the run.
/// \throws InputError
std::vector<NamedSystem> parse_systems(const std::string& text);

}  // namespace fsi
