#pragma once

#include <algorithm>

#include "case/case.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// When fluid and wall agree: the demands of [partitioned] on a pass, as CouplingReport measures it.
class Agreement {
 public:
  /// \param options  must outlive this
  explicit Agreement(const PartitionedData& options) : options_(options) {}

  /// Whether the demand is on the pressure of the gap too (partitioned.tolerance_of).
  bool weighs_pressure() const { return options_.tolerance_of == ToleranceOf::pressure; }
  /// Whether the gap is small enough, by its relative size, its rounding or its size in mm, and the forces balance,
  /// where the case demands that.
  bool met_by(const CouplingReport& pass) const {
    const double residual =
        weighs_pressure() ? std::max(pass.displacement_residual, pass.pressure_residual) : pass.displacement_residual;
    return (residual <= options_.gap_tolerance() || pass.displacement_residual <= displacement_rounding ||
            pass.displacement_gap <= options_.absolute_tolerance) &&
           (options_.force_tolerance == 0 || pass.force_residual <= options_.force_tolerance);
  }

  /// The tightest of the relative demands as a bound on |d~ - d| / |d~|. The demand on the pressure is converted by the
  /// ratio of the two residuals in this pass.
  double demand(const CouplingReport& pass) const {
    double demand = options_.gap_tolerance();
    if (options_.force_tolerance > 0) demand = std::min(demand, options_.force_tolerance);
    if (weighs_pressure() && pass.pressure_residual > pass.displacement_residual)
      demand = std::min(demand, options_.gap_tolerance() * pass.displacement_residual / pass.pressure_residual);
    return demand;
  }

  // Tolerances of the sub-problems' Newton iterations. Accepted passes are solved a hundred times tighter than the
  // interface; early ones a hundred times tighter than their own residual.
  double final_tolerance(const CouplingReport& pass) const {
    return std::max(sub_problem_share * demand(pass), sub_problem_rounding);
  }
  double first_tolerance(const CouplingReport& pass) const { return std::max(1e-4, final_tolerance(pass)); }
  double next_tolerance(const CouplingReport& pass) const {
    return std::clamp(sub_problem_share * pass.displacement_residual, final_tolerance(pass), first_tolerance(pass));
  }
  /// Whether a pass that was solved to `tolerance` is too inexact to judge the gap by: the gap then holds the errors of
  /// the sub-problems.
  bool needs_tighter(double tolerance, const CouplingReport& pass) const {
    return tolerance > std::max(0.1 * demand(pass), final_tolerance(pass));
  }

 private:
  static constexpr double sub_problem_share = 0.01;  ///< tolerance of the sub-problems over the interface residual
  static constexpr double sub_problem_rounding =
      1e-13;  ///< below it increments of their Newton iterations are rounding
  /// Relative interface residual that is rounding of the displacements. It ends the iteration also in steps so short
  /// that the pressure of this gap exceeds the tolerance.
  static constexpr double displacement_rounding = 1e-13;

  const PartitionedData& options_;
};

}  // namespace fsi
