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

  bool weighs_pressure() const { return options_.tolerance_of == ToleranceOf::pressure; }
  bool met_by(const CouplingReport& pass) const {
    const double residual =
        weighs_pressure() ? std::max(pass.displacement_residual, pass.pressure_residual) : pass.displacement_residual;
    return (residual <= options_.gap_tolerance() || pass.displacement_residual <= displacement_rounding ||
            pass.displacement_gap <= options_.absolute_tolerance) &&
           (options_.force_tolerance == 0 || pass.force_residual <= options_.force_tolerance);
  }

  /// The tightest of the demands on the interface, as one on |d~ - d| / |d~|; that on the pressure as the last pass
  /// weighs it.
  double demand(const CouplingReport& pass) const {
    double demand = options_.gap_tolerance();
    if (options_.force_tolerance > 0) demand = std::min(demand, options_.force_tolerance);
    if (weighs_pressure() && pass.pressure_residual > pass.displacement_residual)
      demand = std::min(demand, options_.gap_tolerance() * pass.displacement_residual / pass.pressure_residual);
    return demand;
  }

  // Sub-problems are solved a hundred times tighter than the interface; early passes as loosely as their residual allows.
  double final_tolerance(const CouplingReport& pass) const {
    return std::max(sub_problem_share * demand(pass), sub_problem_rounding);
  }
  double first_tolerance(const CouplingReport& pass) const { return std::max(1e-4, final_tolerance(pass)); }
  double next_tolerance(const CouplingReport& pass) const {
    return std::clamp(sub_problem_share * pass.displacement_residual, final_tolerance(pass), first_tolerance(pass));
  }
  /// Agreement cannot be better than the sub-problems' own accuracy.
  bool needs_tighter(double tolerance, const CouplingReport& pass) const {
    return tolerance > std::max(0.1 * demand(pass), final_tolerance(pass));
  }

 private:
  static constexpr double sub_problem_share = 0.01;  ///< tolerance of the sub-problems over the interface residual
  static constexpr double sub_problem_rounding =
      1e-13;  ///< below it increments of their Newton iterations are rounding
  /// Relative interface residual that is rounding of the displacements: no pass makes it smaller, also where steps are so
  /// short that it stands for a pressure.
  static constexpr double displacement_rounding = 1e-13;

  const PartitionedData& options_;
};

}  // namespace fsi
