#include "nonlinear/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fsi {

namespace {

constexpr double rounding_increment = 1e-14;  // relative to the iterate
constexpr double tiny_increment = 1e-8;       // likewise: what is left of the residual may be rounding
constexpr double kept_forcing = 0.05;      // loosest linear tolerance with a kept Jacobian, which contracts by 5 to 20
constexpr double doubted_forcing = 1e-3;   // where residuals have said too little of errors
constexpr double smallest_forcing = 1e-6;  // more digits of one increment never pay
constexpr int most_switches = 6;           // iterations that end with outdated(); then no growth is accepted for it
constexpr double rounding_margin = 4;      // residuals up to so many times their rounding error are all rounding

const char* const failure_at_start = "the start holds an inverted element or a value that is not finite";
const char* const failure_at_limit = "the iteration limit was reached";

/// Which residuals are nothing but rounding. Costs about two products with the Jacobian, so that few iterations ask.
class Rounding {
 public:
  explicit Rounding(NewtonProblem& problem) : problem_(problem) {}
  /// The iterate is another one: the bound is computed anew when it is asked for.
  void renew() { bound_ = unknown; }
  bool is_all_of(double residual) {
    if (bound_ == unknown) bound_ = rounding_margin * problem_.rounding();
    return residual <= bound_;
  }
  /// Whether an iteration that left this part of the residual has to be judged: not where the part is what kept
  /// Jacobians leave. Should that be all rounding, the next iteration leaves more.
  static bool is_likely(double left) { return !(left > 1e-3 && left < 0.4); }

 private:
  static constexpr double unknown = -1;

  NewtonProblem& problem_;
  double bound_ = unknown;
};

/// Backtracking from an iterate that has already moved by the whole increment: halves the step until the residual has
/// not grown, or is all rounding, or until it exists and the natural monotonicity test holds: |J^-1 R|, J being a new
/// Jacobian, has fallen by a fourth of the step at least ([Deuflhard2011], section 3.3). For where a thin wall bends,
/// residuals grow with the square of a good increment, and steps on which they fall are tiny. A whole step across which
/// something opens or closes is taken, if `may_switch`, though the residual grows: with the derivatives behind it the
/// next one comes back, where shorter ones would creep up to the jump.
/// \param iteration  gets the step's length, 0 when even the shortest fails (the iterate is then where it was)
/// \returns the residual
double backtrack(NewtonProblem& problem, double last_residual, Rounding& rounding, double increment, int max_halvings,
                 bool may_switch, NewtonIteration& iteration) {
  constexpr double looseness = 0.1;  // of distances
  double step = 1, residual = 0;
  for (int halvings = 0;; ++halvings) {
    residual = problem.evaluate();
    bool good = residual <= last_residual;  // no, if it does not exist
    if (!good && std::isfinite(residual)) good = rounding.is_all_of(residual);
    if (halvings == 0 && may_switch && problem.outdated()) good = std::isfinite(residual);
    if (!good && iteration.linearised && std::isfinite(residual)) {
      good = problem.distance(looseness) <= (1 - 0.25 * step) * increment;
      iteration.linear_iterations += problem.linear_iterations();
    }
    if (good) {
      iteration.step = step;
      return residual;
    }
    if (halvings == max_halvings) break;
    problem.move(-0.5 * step);
    step *= 0.5;
  }
  problem.move(-step);
  iteration.step = 0;
  return problem.evaluate();
}

/// Tolerance of the next linear solve. With a new Jacobian the second choice of [Eisenstat1996],
/// eta = 0.9 (|R_k| / |R_(k-1)|)^2, with their safeguard. With a kept one the residual falls by the
/// Jacobian's own error, a factor of each iteration, and solving much tighter than that is wasted.
double forcing_term(const NewtonOptions& options, bool renewed, double ratio, double last_forcing) {
  if (options.linear_tolerance > 0) return options.linear_tolerance;
  double eta = renewed ? options.largest_forcing : std::min(options.largest_forcing, kept_forcing);
  if (ratio < 1) eta = std::min(eta, renewed ? 0.9 * ratio * ratio : 0.5 * ratio);
  const double safeguard = 0.9 * last_forcing * last_forcing;
  if (renewed && safeguard > 0.1) eta = std::min(options.largest_forcing, std::max(eta, safeguard));
  return std::max(eta, smallest_forcing);
}

/// Whether an iteration, beside those before it, shows that the start was far from the solution. The last digits do not
/// count. A new Jacobian's first increment takes over all that would follow from a kept one whose increments are
/// halved, a half, a quarter, ... of its last one.
bool strays(const NewtonIteration& now, const std::vector<NewtonIteration>& before) {
  constexpr double straight = 0.5, all_that_follow = straight / (1 - straight), small = 0.01;
  if (now.step < 1) return true;
  if (before.empty()) return false;
  const bool takes_over = now.linearised && !before.back().linearised;
  return now.increment > (takes_over ? all_that_follow : straight) * before.back().increment &&
         now.increment > small * before.front().increment;
}

/// Estimates the error by the increments to come, if each is `left`, the part of the residual that the last one left,
/// of the one before ([Deuflhard2011], section 2.1). The ratio of increments would estimate the error of the increment
/// before, and for a new Jacobian nothing: its next increment is shorter by far.
double estimated_error(double relative_increment, double left) {
  if (!(left < 1)) return 0;  // it no longer falls: rounding
  return relative_increment * left / (1 - left);
}

/// Estimates the error from the increments of one call. The residual adds up rows of different units: where one kind
/// dominates, it falls though the others' error does not. So what is left is at least the ratio of increments, squared
/// for a new Jacobian; for a first increment, which has no ratio, at least `first_ratio`.
class ErrorWatch {
 public:
  /// \param change   NewtonProblem::relative_increment() of the last increment
  /// \param left     of the residual by it
  /// \param renewed  it came of a new Jacobian
  double estimate(double change, double left, bool renewed) {
    double ratio = first_ratio;
    if (last_change_ > 0) ratio = renewed ? change * change / (last_change_ * last_change_) : change / last_change_;
    last_change_ = change;
    last_left_ = left;
    return to_come(change, std::max(left, ratio));
  }
  /// The same for an increment of a kept Jacobian before its residual is known. Infinite for a first one.
  double foresee(double change) const {
    return last_change_ > 0 ? to_come(change, std::max(last_left_, change / last_change_)) : infinite;
  }

 private:
  static double to_come(double change, double part) { return part < 1 ? change * part / (1 - part) : infinite; }

  static constexpr double first_ratio = 0.1, infinite = std::numeric_limits<double>::infinity();
  double last_change_ = 0, last_left_ = 1;
};

}  // namespace

int NewtonReport::linear_iterations() const {
  int sum = 0;
  for (const auto& iteration : iterations) sum += iteration.linear_iterations;
  return sum;
}

int NewtonReport::linearisations() const {
  int sum = 0;
  for (const auto& iteration : iterations) sum += iteration.linearised ? 1 : 0;
  return sum;
}

const NameTable<NewtonMode>& newton_modes() {
  static const NameTable<NewtonMode> table{"newton.mode", {{"kept", NewtonMode::kept}, {"full", NewtonMode::full}}};
  return table;
}

NewtonReport newton(NewtonProblem& problem, const NewtonOptions& options) {
  NewtonReport report;
  double residual = problem.evaluate();
  report.first_residual = residual;
  if (!std::isfinite(residual)) {
    report.failure = failure_at_start;
    return report;
  }
  double reference = options.reference;
  Rounding rounding(problem);
  const double keep_contraction = options.keep_contraction > 0 ? options.keep_contraction : problem.keep_contraction();
  const bool keep = options.mode != NewtonMode::full;
  int kept_iterations = 0, switches = 0;
  double ratio = 1, forcing = 0;  // of the last two residuals; of the last linear solve
  bool renew = !keep || !problem.linearised() || problem.outdated(), grown = false;
  ErrorWatch watch;
  while (report.count() < options.max_iterations) {
    NewtonIteration iteration;
    iteration.linearised = renew;
    if (renew) problem.linearise();
    if (renew && options.observe_system) options.observe_system(report.count() + 1);
    if (renew) rounding.renew();
    forcing = forcing_term(options, renew, ratio, forcing);
    if (grown && options.linear_tolerance == 0) forcing = std::min(forcing, doubted_forcing);
    const double increment = problem.solve(forcing);
    iteration.linear_iterations = problem.linear_iterations();
    if (!std::isfinite(increment) && !renew) {
      renew = true;  // the solver's preparation may have grown too old
      continue;
    }
    if (!std::isfinite(increment)) {
      const std::string reason = problem.linear_failure();
      report.failure = reason.empty() ? "the linear solver returned a value that is not finite" : reason;
      return report;
    }
    problem.move(1);
    if (options.error_tolerance > 0 && options.residual_tolerance == 0 && !options.last_residual && !renew && !grown &&
        !report.strayed) {
      const double error = watch.foresee(problem.relative_increment());
      if (error <= options.error_tolerance && increment < report.iterations.back().increment) {
        iteration.increment = increment;
        iteration.residual = std::numeric_limits<double>::quiet_NaN();
        report.iterations.push_back(iteration);
        if (options.observe_iteration) options.observe_iteration(report);
        report.error = error;
        report.converged = true;
        return report;
      }
    }
    const double new_residual =
        backtrack(problem, residual, rounding, increment, options.max_halvings, switches < most_switches, iteration);
    if (iteration.step == 0) {
      if (renew) {
        report.failure = "no step along Newton's direction lowers the residual";
        return report;
      }
      renew = true;  // an old Jacobian may point the wrong way: try a new one before giving up
      continue;
    }
    iteration.increment = iteration.step * increment;
    iteration.residual = new_residual;
    report.strayed = report.strayed || strays(iteration, report.iterations);
    report.iterations.push_back(iteration);
    if (options.observe_iteration) options.observe_iteration(report);
    if (reference == 0) reference = increment;

    bool accurate = iteration.increment <= options.tolerance * reference;
    // Increments that grow while residuals fall, as where a wall bends and linear systems are solved to a tenth, show
    // that residuals say little about errors: then both must be small, and linear solves get more digits from there on.
    if (report.count() > 1) grown = grown || iteration.increment > report.iterations[report.count() - 2].increment;
    if (const double change = problem.relative_increment(); options.error_tolerance > 0 && std::isfinite(change))
      accurate =
          watch.estimate(change, new_residual / residual, renew) <= options.error_tolerance && (accurate || !grown);
    if (iteration.step == 1 && new_residual <= options.enough * report.first_residual) {
      report.converged = true;
      return report;
    }
    const bool outdated = problem.outdated();
    if (outdated) ++switches;
    const bool tiny = problem.negligible(increment, tiny_increment);
    const bool small = iteration.step == 1 && !outdated &&
                       (accurate || (tiny && problem.negligible(increment, rounding_increment)) ||
                        (options.stop_at_rounding && (tiny || Rounding::is_likely(new_residual / residual)) &&
                         rounding.is_all_of(new_residual)));
    const bool solved = options.residual_tolerance == 0 ||
                        new_residual <= options.residual_tolerance * report.first_residual ||
                        rounding.is_all_of(new_residual);
    if (small && solved) {
      const double error = estimated_error(problem.relative_increment(), new_residual / residual);
      report.error = std::isfinite(error) ? error : 0;  // infinite: nobody knows what the solution changes
      report.converged = true;
      return report;
    }
    if (renew) kept_iterations = 0;
    ++kept_iterations;
    renew = !keep || outdated ||
            ((new_residual > keep_contraction * residual || kept_iterations >= options.keep_iterations) &&
             !rounding.is_all_of(new_residual));
    ratio = new_residual / residual;
    residual = new_residual;
  }
  report.failure = failure_at_limit;
  return report;
}

}  // namespace fsi
