#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/name_table.hpp"

namespace fsi {

/// What Newton's method needs of a problem R(x) = 0. The problem keeps the iterate, its residual and the last
/// increment.
class NewtonProblem {
 public:
  virtual ~NewtonProblem() = default;
  /// Evaluates the residual at the iterate; returns its norm, or NaN where it does not exist (inverted element).
  virtual double evaluate() = 0;
  /// Builds and factorises the Jacobian at the iterate.
  virtual void linearise() = 0;
  virtual bool linearised() const = 0;
  /// Whether derivatives at the iterate are known to be others than those of the last Jacobian, by far: where something has
  /// opened or closed. Increments then say nothing of the error.
  virtual bool outdated() const { return false; }
  /// Increment = -J^-1 R with the last Jacobian, up to |R + J increment| <= tolerance |R|; returns its norm, NaN when
  /// the linear solver failed.
  virtual double solve(double tolerance) = 0;
  /// Norm of -J^-1 R at the iterate as it is, with the last Jacobian: how far it is from the solution, in no unit of R. The
  /// increment stays what it was. NaN: nobody knows.
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
  /// Whether the last increment, of this norm, is lost in the rounding of the iterate: below `share` of it.
  virtual bool negligible(double increment, double share) const { return increment <= share * size(); }
  /// The last increment relative to what the iterate differs by from the last solution, in time or load; infinite where
  /// nobody knows.
  virtual double relative_increment() const { return std::numeric_limits<double>::infinity(); }
  /// Norm of the rounding error that the residual carries: it cannot be made smaller. 0: unknown. Asked when
  /// linearised.
  virtual double rounding() { return 0; }
};

struct NewtonReport;

/// When Newton's method makes a Jacobian, and when it stops.
enum class NewtonMode {
  kept,  ///< a Jacobian, of earlier calls too, serves while the residual keeps falling (chord iterations)
  full   ///< a new Jacobian each iteration
};

struct NewtonOptions {
  NewtonMode mode = NewtonMode::kept;
  /// Converged when the estimate of NewtonReport::error is at most this; 0, or where nobody knows what the solution
  /// changes: by the increment.
  double error_tolerance = 0;
  /// Converged when the increment's norm is below this times `reference`.
  double tolerance = 1e-8;
  double reference = 0;           ///< 0: the norm of the first increment ([Langer2018], algorithm 1)
  double residual_tolerance = 0;  ///< further demand on the residual relative to the first one; 0: none
  double enough =
      0;  ///< converged when the residual is at most this part of the first one, whatever the increment; 0: never
  int max_iterations = 30;
  double keep_contraction = 0;   ///< a kept Jacobian is renewed when an iteration contracts the residual less (0: as
                                 ///< the problem advises),
  int keep_iterations = 12;      ///< or after so many iterations of one call
  int max_halvings = 8;          ///< of the step in backtracking
  double linear_tolerance = 0;   ///< of every linear solve; 0: inexact Newton, forcing terms as below
  double largest_forcing = 0.1;  ///< loosest linear tolerance of inexact Newton
  bool stop_at_rounding = true;  ///< a residual that is all rounding ends the iteration, whatever the increment
  /// The residual behind the last increment is evaluated, for whoever reads its rows, though what earlier increments left
  /// says already that the error is small enough.
  bool last_residual = true;
  /// Sees each new linear system before it is solved: the number of the iteration, from 1. None: nobody looks.
  std::function<void(int iteration)> observe_system;
  /// Sees how far it has come after each iteration. None: nobody looks.
  std::function<void(const NewtonReport& so_far)> observe_iteration;
};

const NameTable<NewtonMode>& newton_modes();

/// One row of the convergence history.
struct NewtonIteration {
  double increment = 0;     ///< norm of the increment, as taken
  double residual = 0;      ///< norm of the residual after it; not a number: it was not evaluated (last_residual)
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
  /// The way to the solution was no straight one: a step was cut, or an increment too long beside the one before (newton.cpp).
  /// Where Newton's method contracts so fast from the first increment on, it comes to the solution that is nearest
  /// ([Deuflhard2011], section 5.1); where not, to any.
  bool strayed = false;

  int count() const { return static_cast<int>(iterations.size()); }
  int linear_iterations() const;
  int linearisations() const;
};

/// Newton's method with backtracking and, optionally, a kept Jacobian (chord iterations). Reports, never throws.
/// Neither increment nor residual can fall below rounding: an increment of 1e-14 times the iterate, of each of its fields
/// where there are several, or a residual that
/// is nothing but the rounding error of its own evaluation, counts as converged.
NewtonReport newton(NewtonProblem& problem, const NewtonOptions& options);

}  // namespace fsi
