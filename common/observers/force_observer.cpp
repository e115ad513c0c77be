#include "observers/force_observer.hpp"

#include "fem/dimensions.hpp"

namespace fsi {

namespace {

const Columns<SurfaceForce>& surface_columns() {
  using R = SurfaceForce;
  static const Columns<R> columns{{"area_mm2", [](const R& r) { return r.area; }},
                                  {"force_x_mN", [](const R& r) { return r.force[0]; }},
                                  {"force_y_mN", [](const R& r) { return r.force[1]; }},
                                  {"force_z_mN", [](const R& r) { return r.force[2]; }},
                                  {"pressure_force_x_mN", [](const R& r) { return r.pressure[0]; }},
                                  {"pressure_force_y_mN", [](const R& r) { return r.pressure[1]; }},
                                  {"pressure_force_z_mN", [](const R& r) { return r.pressure[2]; }},
                                  {"viscous_force_x_mN", [](const R& r) { return r.force[0] - r.pressure[0]; }},
                                  {"viscous_force_y_mN", [](const R& r) { return r.force[1] - r.pressure[1]; }},
                                  {"viscous_force_z_mN", [](const R& r) { return r.force[2] - r.pressure[2]; }}};
  return columns;
}

template <int n>
class ForceObserver : public Observer {
 public:
  ForceObserver(const SurfaceForces<n>& forces, Profile& profile) : forces_(forces), profile_(profile) {}

  std::vector<ResultTable> tables() const override {
    ResultTable table = table_of(surfaces_file, surface_columns(), RowsPer::within_step, "surface", forces_.names());
    table.missing = {"output.surfaces", "are wanted, but the earlier run wrote none",
                     "continue without output.surfaces and output.forces, or run from the start"};
    return {table};
  }
  bool wants_balances() const override { return true; }
  std::vector<TableRows> after_step(const FinishedStep& step) override {
    const auto measured = profile_.phase("surface forces");
    const Balance& balance = step.report.balances.back();
    return {rows_of(surfaces_file, {balance.data.rates.time}, surface_columns(), forces_.at(balance))};
  }

 private:
  const SurfaceForces<n>& forces_;
  Profile& profile_;
};

}  // namespace

template <int n>
std::unique_ptr<Observer> make_force_observer(const RunView<n>& watched) {
  if (!watched.derived.forces) return nullptr;
  return std::make_unique<ForceObserver<n>>(*watched.derived.forces, watched.scene.profile);
}

#define FSI_INSTANTIATE(n) template std::unique_ptr<Observer> make_force_observer(const RunView<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
