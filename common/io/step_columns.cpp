#include "io/step_columns.hpp"

namespace fsi {

const Columns<StepRecord>& iteration_columns() {
  using R = StepRecord;
  static const Columns<R> columns{
      {"outer_iterations", [](const R& r) { return static_cast<double>(r.outer_iterations); }},
      {"newton_iterations", [](const R& r) { return static_cast<double>(r.newton_iterations); }},
      {"linear_iterations", [](const R& r) { return static_cast<double>(r.linear_iterations); }},
      {"wall_s", [](const R& r) { return r.wall_seconds; }},
      {"solver_error", [](const R& r) { return r.solver_error; }}};
  return columns;
}

const Columns<CouplingRecord>& coupling_columns() {
  using R = CouplingRecord;
  static const Columns<R> columns{
      {"iterations", [](const R& r) { return static_cast<double>(r.passes); }},
      {"failed_passes", [](const R& r) { return static_cast<double>(r.report.failed_passes); }},
      {"relaxation", [](const R& r) { return r.report.relaxation; }},
      {"columns", [](const R& r) { return static_cast<double>(r.report.columns); }},
      {"displacement_residual", [](const R& r) { return r.report.displacement_residual; }},
      {"displacement_residual_mm", [](const R& r) { return r.report.displacement_gap; }},
      {"force_residual", [](const R& r) { return r.report.force_residual; }},
      {"fluid_newton_iterations", [](const R& r) { return static_cast<double>(r.report.fluid_newton_iterations); }},
      {"wall_newton_iterations", [](const R& r) { return static_cast<double>(r.report.wall_newton_iterations); }},
      {"fluid_linear_iterations", [](const R& r) { return static_cast<double>(r.report.fluid_linear_iterations); }},
      {"wall_linear_iterations", [](const R& r) { return static_cast<double>(r.report.wall_linear_iterations); }},
      {"fluid_s", [](const R& r) { return r.report.fluid_seconds; }},
      {"wall_s", [](const R& r) { return r.report.wall_seconds; }},
      {"mesh_motion_s", [](const R& r) { return r.report.mesh_seconds; }},
      {"coupling_s", [](const R& r) { return r.report.algebra_seconds; }},
      {"pressure_residual", [](const R& r) { return r.report.pressure_residual; }}};
  return columns;
}

}  // namespace fsi
