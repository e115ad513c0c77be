#include "io/energy_table.hpp"

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
};

}  // namespace

Columns<EnergyRecord> energy_columns(const EnergyParts& parts) {
  Columns<EnergyRecord> columns;
  for (const auto& [column, present] : all_columns)
    if (present(parts)) columns.push_back(column);
  return columns;
}

}  // namespace fsi
