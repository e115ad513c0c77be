#pragma once

#include <vector>

namespace fsi {

/// An approximate inverse A~^-1 of a sub-problem's matrix (mesh motion, flow or wall): linear, and the same from one
/// call to the next.
class SubSolver {
 public:
  virtual ~SubSolver() = default;
  /// x = A~^-1 b
  void solve(const std::vector<double>& b, std::vector<double>& x) {
    ++cycles_;
    x.resize(b.size());
    apply(b, x);
  }
  /// Calls of solve so far.
  long long cycles() const { return cycles_; }

 private:
  virtual void apply(const std::vector<double>& b, std::vector<double>& x) = 0;
  long long cycles_ = 0;
};

/// Sub-solvers of the three blocks of one level.
struct SubSolvers {
  SubSolver& mesh;
  SubSolver& fluid;
  SubSolver& wall;
};

}  // namespace fsi
