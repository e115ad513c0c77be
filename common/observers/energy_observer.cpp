#include "observers/energy_observer.hpp"

#include <optional>

#include "diagnostics/energy_balance.hpp"
#include "fem/dimensions.hpp"

namespace fsi {

namespace {

struct PartColumn {
  Column<EnergyRecord> column;
  bool (*present)(const EnergyParts& parts);
};

bool always(const EnergyParts&) {
  return true;
}
bool fluid(const EnergyParts& parts) {
  return parts.fluid;
}
bool wall(const EnergyParts& parts) {
  return parts.wall;
}
bool moving_wall(const EnergyParts& parts) {
  return parts.wall && parts.in_time;
}
bool wall_alone(const EnergyParts& parts) {
  return parts.wall && !parts.fluid;
}

using R = EnergyRecord;
constexpr PartColumn all_columns[] = {
    {{"fluid_kinetic_energy_uJ", [](const R& r) { return r.fluid_kinetic; }}, fluid},
    {{"wall_kinetic_energy_uJ", [](const R& r) { return r.wall_kinetic; }}, moving_wall},
    {{"wall_isochoric_energy_uJ", [](const R& r) { return r.wall_isochoric; }}, wall},
    {{"wall_volumetric_energy_uJ", [](const R& r) { return r.wall_volumetric; }}, wall},
    {{"inlet_work_uJ", [](const R& r) { return r.inlet_work; }}, fluid},
    {{"load_work_uJ", [](const R& r) { return r.load_work; }}, wall_alone},
    {{"inlet_kinetic_inflow_uJ", [](const R& r) { return r.inlet_kinetic; }}, fluid},
    {{"outlet_kinetic_outflow_uJ", [](const R& r) { return r.outlet_kinetic; }}, fluid},
    {{"viscous_dissipation_uJ", [](const R& r) { return r.viscous; }}, fluid},
    {{"numerical_dissipation_uJ", [](const R& r) { return r.numerical(); }}, always},
    {{"remainder_uJ", [](const R& r) { return r.remainder; }}, always},
    {{"fluid_inertia_uJ", [](const R& r) { return r.fluid_inertia; }}, fluid},
    {{"fluid_mesh_motion_uJ", [](const R& r) { return r.fluid_mesh_motion; }},
     [](const EnergyParts& parts) { return parts.fluid && parts.wall; }},
    {{"fluid_divergence_uJ", [](const R& r) { return r.fluid_divergence; }}, fluid},
    {{"fluid_stabilisation_uJ", [](const R& r) { return r.fluid_stabilisation; }}, fluid},
    {{"wall_inertia_uJ", [](const R& r) { return r.wall_inertia; }}, moving_wall},
    {{"wall_stress_uJ", [](const R& r) { return r.wall_stress; }}, wall},
    {{"wall_stabilisation_uJ", [](const R& r) { return r.wall_stabilisation; }}, wall},
    {{"fluid_quadrature_uJ", [](const R& r) { return r.fluid_quadrature; }},
     [](const EnergyParts& parts) { return parts.fluid && parts.quadratic; }},
    {{"backflow_dissipation_uJ", [](const R& r) { return r.backflow; }},
     [](const EnergyParts& parts) { return parts.fluid && parts.backflow; }},
    {{"support_work_uJ", [](const R& r) { return r.support_work; }},
     [](const EnergyParts& parts) { return parts.support_loads; }},
    {{"spring_energy_uJ", [](const R& r) { return r.springs; }},
     [](const EnergyParts& parts) { return parts.springs; }},
    {{"damper_dissipation_uJ", [](const R& r) { return r.damping; }},
     [](const EnergyParts& parts) { return parts.dampers; }},
    {{"spring_force_uJ", [](const R& r) { return r.support_springs; }},
     [](const EnergyParts& parts) { return parts.springs; }},
    {{"wall_viscous_dissipation_uJ", [](const R& r) { return r.wall_viscous; }},
     [](const EnergyParts& parts) { return parts.viscous_wall; }},
    {{"wall_branch_energy_uJ", [](const R& r) { return r.wall_branches; }},
     [](const EnergyParts& parts) { return parts.branches; }},
};

template <int n>
class EnergyObserver : public Observer {
 public:
  explicit EnergyObserver(const Scene<n>& scene)
      : scene_(scene), columns_(energy_columns(EnergyBalance<n>::parts_of(scene))) {}

  std::vector<ResultTable> tables() const override {
    ResultTable table = table_of(energy_file, columns_, RowsPer::step);
    // Runs with the energy balance switched off write no such table.
    table.missing = {"output.energy", "is wanted, but the earlier run wrote none",
                     "continue with --set output.energy=false"};
    return {table};
  }
  bool wants_balances() const override { return true; }
  void begin(const State& state) override {
    const auto measured = scene_.profile.phase(phase());
    balance_.emplace(scene_, state);
  }
  std::vector<TableRows> after_step(const FinishedStep& step) override {
    const EnergyRecord energy = balance_->step_to(step.state, step.report);
    return {rows_of(energy_file, {static_cast<double>(step.record.step), step.record.time}, columns_, {energy})};
  }
  const char* phase() const override { return "energy balance"; }

 private:
  const Scene<n>& scene_;
  Columns<EnergyRecord> columns_;
  std::optional<EnergyBalance<n>> balance_;
};

}  // namespace

Columns<EnergyRecord> energy_columns(const EnergyParts& parts) {
  Columns<EnergyRecord> columns;
  for (const auto& [column, present] : all_columns)
    if (present(parts)) columns.push_back(column);
  return columns;
}

template <int n>
std::unique_ptr<Observer> make_energy_observer(const RunView<n>& watched) {
  if (!watched.setup.output.energy) return nullptr;
  return std::make_unique<EnergyObserver<n>>(watched.scene);
}

#define FSI_INSTANTIATE(n) template std::unique_ptr<Observer> make_energy_observer(const RunView<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
