#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/result_tables.hpp"

namespace fsi::test {

/// A table of each kind.
inline const ResultTable steps_table{iterations_file, "step,time_ms,newton_iterations,wall_s", RowsPer::step};
inline const ResultTable energy_table{
    "energy.csv",
    "step,time_ms,energy_uJ",
    RowsPer::step,
    {},
    {},
    {},
    false,
    ResultTable::Missing{"output.energy", "is wanted, but the earlier run wrote none", "continue without"}};
inline ResultTable centre_table(std::vector<double> z) {
  return {"centerline_pressure.csv", "time_ms,z_mm,pressure_Pa", RowsPer::level, {}, std::move(z)};
}
inline ResultTable wall_table(std::vector<double> z) {
  return {"wall_displacement.csv", "time_ms,z_mm,radial_mm,axial_mm", RowsPer::level, {}, std::move(z)};
}
inline const ResultTable flow_table{"flow.csv",
                                    "time_ms,inlet_flow_mm3_per_ms,inlet_pressure_Pa",
                                    RowsPer::level,
                                    {},
                                    {},
                                    {Measure::flow, Measure::pressure}};

inline std::vector<std::string> files_of(const std::vector<ResultTable>& tables) {
  std::vector<std::string> files;
  for (const ResultTable& table : tables) files.push_back(table.file);
  return files;
}

}  // namespace fsi::test
