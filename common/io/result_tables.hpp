#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnostics/energy_record.hpp"
#include "io/sampled_table.hpp"

namespace fsi {

/// Which tables a scene has besides iterations.csv.
struct ResultTables {
  bool centerline_pressure = false;     ///< scenes with fluid
  bool wall_displacement = false;       ///< scenes with a wall
  bool flow = false;                    ///< scenes with fluid
  bool coupling = false;                ///< partitioned runs
  std::optional<EnergyParts> energy{};  ///< unless the case does not want it
  std::vector<std::string> openings{};  ///< names of those that openings.csv has rows for; empty: no such table
  std::vector<std::string> surfaces{};  ///< names whose forces the case asks for
  std::vector<SampledTable> sampled{};  ///< that the case asks for
};

/// A table of a result folder.
struct ResultTable {
  std::string file;
  std::string header;
  bool of_steps = false;  ///< a row for each step, `step,time_ms,...`; else rows for each level, `time_ms,...`
  /// A row for each of these at each level, or step, the name in the second column. Empty: all columns are numbers.
  std::vector<std::string> names{};
  bool within_steps = false;  ///< rows for each step, `time_ms,...`, at one time within it or at its end
};

/// By name: what each table is. energy.csv has the columns of the parts that a scene has.
ResultTable iterations_table();
ResultTable centerline_table();
ResultTable wall_table();
ResultTable flow_table();
ResultTable openings_table(const std::vector<std::string>& names);
ResultTable coupling_table();
ResultTable energy_table(const EnergyParts& parts);
ResultTable surfaces_table(const std::vector<std::string>& names);

/// Those of a run, iterations.csv first.
std::vector<ResultTable> tables_of(const ResultTables& wanted);

}  // namespace fsi
