#pragma once

#include <functional>
#include <string>
#include <vector>

namespace fsi {

/// y = L x. `y` has its size already and is overwritten; x and y are different vectors.
using LinearOperator = std::function<void(const std::vector<double>& x, std::vector<double>& y)>;

struct KrylovOptions {
  double tolerance = 1e-8;   ///< converged when |b - A x| <= tolerance |b|, the residual being computed, not estimated
  int max_iterations = 500;  ///< applications of A inside the iteration
  int restart = 250;         ///< directions kept before the method starts again from its iterate
};

/// What an iterative solver did. An iteration limit is never called convergence.
struct KrylovReport {
  bool converged = false;
  int iterations = 0;
  double relative_residual = 0;  ///< |b - A x| / |b| of the returned x, computed from scratch
  std::vector<double> history;   ///< relative residual at the start and after each iteration; estimates inside a cycle
  std::string failure;           ///< why it stopped, when it did not converge
};

}  // namespace fsi
