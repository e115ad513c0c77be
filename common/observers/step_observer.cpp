#include "observers/step_observer.hpp"

#include "fem/dimensions.hpp"

namespace fsi {

namespace {

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

/// The coupling iteration of a step.
struct CouplingRecord {
  int passes = 0;
  CouplingReport report;
};

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
      {"pressure_residual", [](const R& r) { return r.report.pressure_residual; }},
      {"gap_kPa", [](const R& r) { return r.report.gap_pressure; }},
      {"traction_gap_kPa", [](const R& r) { return r.report.traction_gap; }},
      {"domain_gap_mm", [](const R& r) { return r.report.domain_gap; }}};
  return columns;
}

class StepObserver : public Observer {
 public:
  explicit StepObserver(bool couples) : couples_(couples) {}

  std::vector<ResultTable> tables() const override {
    std::vector<ResultTable> tables{table_of(iterations_file, iteration_columns(), RowsPer::step)};
    if (couples_) tables.push_back(table_of(coupling_file, coupling_columns(), RowsPer::step));
    return tables;
  }
  std::vector<TableRows> after_step(const FinishedStep& step) override {
    const std::vector<double> lead{static_cast<double>(step.record.step), step.record.time};
    std::vector<TableRows> found{rows_of(iterations_file, lead, iteration_columns(), {step.record})};
    if (const auto& report = step.report.coupling)
      found.push_back(rows_of(coupling_file, lead, coupling_columns(), {{step.report.outer_iterations, *report}}));
    return found;
  }

 private:
  bool couples_;
};

}  // namespace

template <int n>
std::unique_ptr<Observer> make_step_observer(const RunView<n>& watched) {
  return std::make_unique<StepObserver>(watched.stepper.reports_coupling());
}

#define FSI_INSTANTIATE(n) template std::unique_ptr<Observer> make_step_observer(const RunView<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
