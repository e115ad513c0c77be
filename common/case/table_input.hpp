#pragma once

#include <cstddef>
#include <optional>
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
  const Quantity& values;  ///< their unit
  ColumnKind column;       ///< what units the header of a file may name
};
const TableKind& pressure_kind();
/// \param plane  of a scene in which flows are those through 1 mm of thickness
const TableKind& flow_rate_kind(bool plane = false);

/// A value over time as it stands in a case file.
struct TableInput {
  PressureTable table;
  bool is_table = false;  ///< rows, of the case file or of a CSV file
  std::optional<double> until;
  std::optional<double> period;
};

/// Reads a number, a table of [time, value], { file = "NAME.csv" }, two columns below a header line, or { rows = [...] }.
/// A unit that the header, time_unit or value_unit beside it name (case/table_units.hpp) is converted, with a remark.
/// \throws InputError that names the row, or file and line
/// \param with_file  whether a section is allowed
void read_table(const CaseEntry& entry, const TableKind& kind, bool with_file, TableInput& input);
void read_until(const CaseEntry& entry, TableInput& input);
void read_period(const CaseEntry& entry, TableInput& input);
/// Makes the table whole once all of it is read.
/// \param entry  the section that `until` and `period` stand in
void finish_table(const CaseEntry& entry, const TableKind& kind, TableInput& input);

/// The rows as canonical text.
std::string text_of_table(const PressureTable& table);

}  // namespace fsi
