#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/quantity.hpp"
#include "case/case_keys.hpp"
#include "case/pressure_table.hpp"
#include "case/table_units.hpp"

namespace fsi {

inline constexpr std::size_t most_table_rows = 100'000;  ///< of a table in a case file

/// What a table over time holds.
struct TableKind {
  const char* key;         ///< "pressure"
  const char* plural;      ///< "pressures"
  const Quantity& values;  ///< with their unit
  ColumnKind column;       ///< which units the header of a file may name
};
const TableKind& pressure_kind();
/// \param plane  for plane scenes, where flows are those through 1 mm of thickness
const TableKind& flow_rate_kind(bool plane = false);

/// A value over time as it stands in a case file.
struct TableInput {
  PressureTable table;
  bool is_table = false;         ///< has rows, of the case file or of a CSV file
  std::optional<double> until;   ///< ms
  std::optional<double> period;  ///< ms
};

/// Reads a number, a table of [time, value], { file = "NAME.csv" } with two columns below a header, or { rows = [...]
/// }. Units that the header, time_unit or value_unit name (case/table_units.hpp) are converted, with a remark.
/// \throws InputError that names the row, or file and line
/// \param with_file  whether the last two forms are allowed
void read_table(const CaseEntry& entry, const TableKind& kind, bool with_file, TableInput& input);
void read_until(const CaseEntry& entry, TableInput& input);
void read_period(const CaseEntry& entry, TableInput& input);
/// Applies `until` and `period` to the table once all keys are read.
/// \param entry  the section of `until` and `period` \throws InputError where they contradict the table
void finish_table(const CaseEntry& entry, const TableKind& kind, TableInput& input);
/// The rows of a table in the case file. \throws InputError for more than most_table_rows
std::vector<CaseEntry> rows_of_table(const CaseEntry& entry);
/// Requires rows sorted by time, at most two of one time, of a table that ends with the last one read.
void check_last_row(const std::vector<std::pair<double, double>>& points,
                    const std::function<void(const std::string& problem, const std::string& remedy)>& refuse);
/// Each jump ends a step: refuses a period in which a run up to `end` (ms) would have too many.
/// \param entry  the section of `period`
void check_jumps(const CaseEntry& entry, const PressureTable& table, double end);

/// The rows as canonical text.
std::string text_of_table(const PressureTable& table);

}  // namespace fsi
