#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "nonlinear/newton.hpp"
#include "system/newton_stepper.hpp"

namespace fsi {

/// A pass through the sub-problems that found no answer: an inverted element, or a Newton iteration that failed. The
/// coupling may try again closer to its last good iterate.
class PassFailure : public std::runtime_error {
 public:
  PassFailure(const std::string& problem, std::vector<std::string> history)
      : std::runtime_error(problem), history_(std::move(history)) {}
  const std::vector<std::string>& history() const { return history_; }

 private:
  std::vector<std::string> history_;
};

/// What the sub-problems of one time step took so far.
struct CouplingCost {
  int fluid_newton = 0, wall_newton = 0;  ///< Newton iterations
  int fluid_linear = 0, wall_linear = 0;  ///< Krylov iterations; 0 with direct solvers
  double fluid_seconds = 0, wall_seconds = 0, mesh_seconds = 0;

  CouplingCost& operator+=(const CouplingCost& other) {
    fluid_newton += other.fluid_newton;
    wall_newton += other.wall_newton;
    fluid_linear += other.fluid_linear;
    wall_linear += other.wall_linear;
    fluid_seconds += other.fluid_seconds;
    wall_seconds += other.wall_seconds;
    mesh_seconds += other.mesh_seconds;
    return *this;
  }
};

/// Seconds of the enclosing block, added to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum), start_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sum_;
  std::chrono::steady_clock::time_point start_;
};

/// Solves one sub-problem by Newton's method up to increments below `tolerance` times its iterate. The increment of
/// each field by itself is brought below 30 times that, as far as rounding allows: in the norm of all fields,
/// displacements of short steps do not count beside pressures. Factors or preconditioners of earlier passes and steps
/// are kept while the iteration contracts.
/// \param newton_iterations, linear_iterations  counters, added to
/// \throws PassFailure where Newton's method does not converge
inline void solve_sub_problem(const std::string& name, NewtonProblem& problem, double tolerance, NewtonOptions options,
                              int& newton_iterations, int& linear_iterations) {
  options.tolerance = tolerance;
  options.reference = problem.size();
  constexpr int most_repeats = 4;     // a field that is nothing but rounding never meets its tolerance
  constexpr double field_share = 30;  // the interface's tolerance is a hundred times the sub-problems'
  NewtonReport report;
  for (int repeats = 0; repeats <= most_repeats; ++repeats) {
    NewtonReport next = newton(problem, options);
    newton_iterations += next.count();
    linear_iterations += next.linear_iterations();
    if (repeats > 0 && !next.converged) return;  // no better than it was
    report = std::move(next);
    if (!report.converged) break;
    if (problem.negligible(report.iterations.back().increment, field_share * tolerance)) return;
    options.stop_at_rounding = false;  // rounding of the largest rows may hide small rows that are out of balance
  }
  if (report.converged) return;
  std::vector<std::string> history{fmt::format("{} sub-problem, first residual {:.3e}", name, report.first_residual)};
  append_history(report, history, "  ");
  throw PassFailure(fmt::format("the {} sub-problem: Newton's method stopped after {} iterations: {}", name,
                                report.count(), report.failure),
                    std::move(history));
}

/// At most `most` iterations of Newton's method, without a tolerance: the coupling goes on with the iterate. A Jacobian
/// that contracts too little is discarded.
/// \param enough  ends the iterations sooner, at this part of the first residual
/// \param newton_iterations, linear_iterations  counters, added to
/// \throws PassFailure where Newton's method fails before: no step lowers the residual, or the linear solver fails
template <class Problem>
void improve_sub_problem(const std::string& name, Problem& problem, int most, double enough, NewtonOptions options,
                         int& newton_iterations, int& linear_iterations) {
  options.tolerance = 0;  // rounding ends them, or these limits
  options.reference = problem.size();
  options.max_iterations = most;
  options.enough = enough;
  options.stop_at_rounding = false;
  const NewtonReport report = newton(problem, options);
  newton_iterations += report.count();
  linear_iterations += report.linear_iterations();
  if (report.count() < most && !report.converged)
    throw PassFailure(fmt::format("the {} sub-problem: Newton's method stopped after {} iterations: {}", name,
                                  report.count(), report.failure),
                      {});
  const double contraction = options.keep_contraction > 0 ? options.keep_contraction : problem.keep_contraction();
  if (report.count() == 0) return;
  const double before = report.count() > 1 ? report.iterations[report.count() - 2].residual : report.first_residual;
  if (!report.converged && report.iterations.back().residual > contraction * before) problem.forget_jacobian();
}

/// One step of Newton's method without backtracking; makes a Jacobian only where there is none.
/// \param tolerance  of the linear solve, relative
/// \throws PassFailure for an inverted element at the start, or where the linear solver fails
inline void solve_linearised(const std::string& name, NewtonProblem& problem, double tolerance, int& newton_iterations,
                             int& linear_iterations) {
  if (!std::isfinite(problem.evaluate())) throw PassFailure("the " + name + " sub-problem: inverted element", {});
  if (!problem.linearised()) problem.linearise();
  if (!std::isfinite(problem.solve(tolerance)))
    throw PassFailure(fmt::format("the {} sub-problem: {}", name, problem.linear_failure()), {});
  newton_iterations += 1;
  linear_iterations += problem.linear_iterations();
  problem.move(1);
}

}  // namespace fsi
