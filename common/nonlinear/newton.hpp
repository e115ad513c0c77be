#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/name_table.hpp"

namespace fsi {

/// A problem R(x) = 0 for Newton's method. It keeps the iterate, its residual and the last increment.
class NewtonProblem {
 public:
  virtual ~NewtonProblem() = default;
  /// Evaluates the residual at the iterate; returns its norm, or NaN where it does not exist (inverted element).
  virtual double evaluate() = 0;
  /// Builds and factorises the Jacobian at the iterate.
  virtual void linearise() = 0;
  virtual bool linearised() const = 0;
  /// Whether derivatives at the iterate are known to be far from those of the last Jacobian, since something has opened
  /// or closed. Increments then say nothing about the error.
  virtual bool outdated() const { return false; }
  /// Increment = -J^-1 R with the last Jacobian, up to |R + J increment| <= tolerance |R|; returns its norm, NaN when
  /// the linear solver failed.
  virtual double solve(double tolerance) = 0;
  /// Norm of J^-1 R at the iterate, with the last Jacobian: the distance from the solution, independent of the units of
  /// R. The increment stays what it was. NaN: not known.
  virtual double distance(double /*tolerance*/) { return std::numeric_limits<double>::quiet_NaN(); }
  /// Advice for NewtonOptions::keep_contraction.
  virtual double keep_contraction() const { return 0.4; }
  /// Iterations of the last solve or distance, and why the solve failed.
  virtual int linear_iterations() const { return 0; }
  virtual std::string linear_failure() const { return {}; }
  /// Iterate += step * increment.
  virtual void move(double step) = 0;
  /// Norm of the iterate, in the norm of the increments.
  virtual double size() const = 0;
  /// Whether the last increment, of this norm, is at most `share` of the iterate.
  virtual bool negligible(double increment, double share) const { return increment <= share * size(); }
  /// The last increment over the iterate's difference from the last solution, in time or load; infinite: unknown.
  virtual double relative_increment() const { return std::numeric_limits<double>::infinity(); }
  /// Norm of the rounding error of the residual; 0: unknown. Only to be called when linearised.
  virtual double rounding() { return 0; }
};

struct NewtonReport;

/// When Newton's method makes a Jacobian, and when it stops.
enum class NewtonMode {
  kept,  ///< a Jacobian, also of earlier calls, is used while the residual keeps falling (chord iterations)
  full   ///< a new Jacobian each iteration
};

struct NewtonOptions {
  NewtonMode mode = NewtonMode::kept;
  /// Converged when the estimated error is at most this; 0, or where relative_increment() is unknown: by the increment.
  double error_tolerance = 0;
  /// Converged when the increment's norm is below this times `reference`.
  double tolerance = 1e-8;
  double reference = 0;           ///< 0: the norm of the first increment ([Langer2018], algorithm 1)
  double residual_tolerance = 0;  ///< further demand on the residual relative to the first one; 0: none
  /// Converged when the residual is at most this part of the first one, whatever the increment; 0: never.
  double enough = 0;
  int max_iterations = 30;
  double keep_contraction = 0;   ///< a kept Jacobian is renewed when the residual falls less (0: the problem's advice),
  int keep_iterations = 12;      ///< or after so many iterations of one call
  int max_halvings = 8;          ///< of the step in backtracking
  double linear_tolerance = 0;   ///< of every linear solve; 0: inexact Newton, forcing terms as below
  double largest_forcing = 0.1;  ///< loosest linear tolerance of inexact Newton
  bool stop_at_rounding = true;  ///< a residual that is all rounding ends the iteration, whatever the increment
  /// Whether the residual after the last increment is evaluated, for callers that read its rows, also where earlier
  /// increments show that the error is small enough.
  bool last_residual = true;
  /// Called with each new linear system before it is solved: the number of the iteration, from 1. May be empty.
  std::function<void(int iteration)> observe_system;
  /// Called after each iteration. May be empty.
  std::function<void(const NewtonReport& so_far)> observe_iteration;
};

const NameTable<NewtonMode>& newton_modes();

/// One row of the convergence history.
struct NewtonIteration {
  double increment = 0;     ///< norm of the increment, as taken
  double residual = 0;      ///< norm of the residual after it; NaN: it was not evaluated (last_residual)
  double step = 1;          ///< length of the step: 1 unless backtracking cut it
  bool linearised = false;  ///< a new Jacobian was made for it
  int linear_iterations = 0;
};

struct NewtonReport {
  bool converged = false;
  double first_residual = 0;
  /// Estimated error of the last iterate, of this call alone, relative to what the solution changes: with delta its
  /// last increment and rho the part of the residual that this left, rho / (1 - rho) times
  /// NewtonProblem::relative_increment() (docs/theory.md, section 9.3). 0: all that is left is rounding.
  double error = 0;
  std::vector<NewtonIteration> iterations;
  std::string failure;  ///< why it stopped, when it did not converge
  /// A step was cut, or an increment was too long beside the one before (newton.cpp). Where Newton's method contracts
  /// fast from the first increment on, it converges to the nearest solution ([Deuflhard2011], section 5.1); where not,
  /// to any.
  bool strayed = false;

  int count() const { return static_cast<int>(iterations.size()); }
  int linear_iterations() const;
  int linearisations() const;
};

/// Newton's method with backtracking and, optionally, a kept Jacobian (chord iterations). Throws only what the problem
/// throws. Neither increment nor residual can fall below rounding: an increment of 1e-14 times the iterate, of each of
/// its fields where there are several, or a residual that is all rounding error counts as converged.
NewtonReport newton(NewtonProblem& problem, const NewtonOptions& options);

}  // namespace fsi
