#include "io/result_tables.hpp"

#include "io/energy_table.hpp"

namespace fsi {

ResultTable iterations_table() {
  return {"iterations.csv",
          "step,time_ms,outer_iterations,newton_iterations,linear_iterations,wall_s,"
          "solver_error",
          true};
}

ResultTable centerline_table() {
  return {"centerline_pressure.csv", "time_ms,z_mm,pressure_Pa"};
}

ResultTable wall_table() {
  return {"wall_displacement.csv", "time_ms,z_mm,radial_mm,axial_mm"};
}

ResultTable flow_table() {
  return {"flow.csv", "time_ms,inlet_flow_mm3_per_ms,outlet_flow_mm3_per_ms,inlet_pressure_Pa,outlet_pressure_Pa"};
}

ResultTable openings_table(const std::vector<std::string>& names) {
  return {"openings.csv", "time_ms,opening,flow_mm3_per_ms,mean_pressure_Pa,windkessel_pressure_Pa", false, names};
}

ResultTable coupling_table() {
  return {
      "coupling.csv",
      "step,time_ms,iterations,failed_passes,relaxation,columns,displacement_residual,displacement_residual_mm,"
      "force_residual,fluid_newton_iterations,wall_newton_iterations,fluid_linear_iterations,wall_linear_iterations,"
      "fluid_s,wall_s,mesh_motion_s,coupling_s,pressure_residual",
      true};
}

ResultTable energy_table(const EnergyParts& parts) {
  return {"energy.csv", energy_header(parts), true};
}

ResultTable surfaces_table(const std::vector<std::string>& names) {
  return {"surfaces.csv",
          "time_ms,surface,area_mm2,force_x_mN,force_y_mN,force_z_mN,pressure_force_x_mN,pressure_force_y_mN,"
          "pressure_force_z_mN,viscous_force_x_mN,viscous_force_y_mN,viscous_force_z_mN",
          false, names, true};
}

std::vector<ResultTable> tables_of(const ResultTables& wanted) {
  std::vector<ResultTable> tables{iterations_table()};
  if (wanted.centerline_pressure) tables.push_back(centerline_table());
  if (wanted.wall_displacement) tables.push_back(wall_table());
  if (wanted.flow) tables.push_back(flow_table());
  if (!wanted.openings.empty()) tables.push_back(openings_table(wanted.openings));
  if (wanted.coupling) tables.push_back(coupling_table());
  if (wanted.energy) tables.push_back(energy_table(*wanted.energy));
  if (!wanted.surfaces.empty()) tables.push_back(surfaces_table(wanted.surfaces));
  for (const SampledTable& table : wanted.sampled) tables.push_back({table.file, table.header});
  return tables;
}

}  // namespace fsi
