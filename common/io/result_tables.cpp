#include "io/result_tables.hpp"

#include "io/energy_table.hpp"
#include "io/level_columns.hpp"
#include "io/step_columns.hpp"

namespace fsi {

ResultTable iterations_table() {
  return {"iterations.csv", header_of("step,time_ms", iteration_columns()), true};
}

ResultTable centerline_table() {
  return {"centerline_pressure.csv", header_of("time_ms", centreline_columns())};
}

ResultTable wall_table() {
  return {"wall_displacement.csv", header_of("time_ms", wall_columns())};
}

ResultTable flow_table() {
  return {"flow.csv", header_of("time_ms", flow_columns())};
}

ResultTable openings_table(const std::vector<std::string>& names) {
  return {"openings.csv", header_of("time_ms,opening", opening_columns()), false, names};
}

ResultTable coupling_table() {
  return {"coupling.csv", header_of("step,time_ms", coupling_columns()), true};
}

ResultTable energy_table(const EnergyParts& parts) {
  return {"energy.csv", header_of("step,time_ms", energy_columns(parts)), true};
}

ResultTable surfaces_table(const std::vector<std::string>& names) {
  return {"surfaces.csv", header_of("time_ms,surface", surface_columns()), false, names, true};
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
