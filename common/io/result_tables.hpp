#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/column.hpp"

namespace fsi {

/// How the rows of a table follow the steps of a run.
enum class RowsPer {
  step,        ///< one for each step, `step,time_ms,...`
  level,       ///< one or more for each finished level, `time_ms,...`
  within_step  ///< one or more for each step, `time_ms,...`, all at one time within it or at its end
};

/// A table of a result folder.
struct ResultTable {
  std::string file;
  std::string header;
  RowsPer per = RowsPer::level;
  /// One row each, with this text between its time and its values: a name, perhaps with further columns of text. Empty:
  /// all columns are numbers.
  std::vector<std::string> names{};
  std::vector<double> places{};     ///< one row each, with this as its first value; empty: no such rows
  std::vector<Measure> measures{};  ///< per value, for the comparison of a restart with the last level; empty: none
  bool blanks = false;              ///< whether values may be missing: empty cells
  /// Message when a restarted run has no such table: key of the case, problem, remedy. Empty: every run of the case has
  /// it.
  struct Missing {
    std::string key, problem, remedy;
  };
  std::optional<Missing> missing{};

  std::size_t rows() const;  ///< for a level or a step
};

/// The values of a row, in the table's units; an empty one: the value does not exist.
using TableRow = std::vector<std::optional<double>>;

/// The rows of a table for a level or a step.
struct TableRows {
  std::string file;
  std::vector<double> lead;  ///< step and time, or time in ms
  std::vector<TableRow> rows;
};

/// A table with a column for each column of a record. \param named  heading of the column of names; empty: none
template <class Record>
ResultTable table_of(const std::string& file, const Columns<Record>& columns, RowsPer per = RowsPer::level,
                     const std::string& named = "", std::vector<std::string> names = {}) {
  ResultTable table{file, per == RowsPer::step ? "step,time_ms" : "time_ms", per, std::move(names)};
  if (!named.empty()) table.header += "," + named;
  table.header = header_of(table.header, columns);
  for (const auto& column : columns) {
    table.measures.push_back(column.measure);
    table.blanks = table.blanks || column.exists != nullptr;
  }
  return table;
}

/// A row for each record.
template <class Record>
TableRows rows_of(const std::string& file, std::vector<double> lead, const Columns<Record>& columns,
                  const std::vector<Record>& records) {
  TableRows found{file, std::move(lead), {}};
  for (const Record& record : records) {
    found.rows.emplace_back();
    for (const auto& column : columns)
      found.rows.back().push_back(column.exists == nullptr || column.exists(record)
                                      ? std::optional<double>(column.value(record))
                                      : std::nullopt);
  }
  return found;
}

/// The rows as text of the file. \throws ConvergenceError when a number is not finite
std::string text_of(const ResultTable& table, const TableRows& rows);

/// A number as the tables show it: the fewest digits that read back to the same double.
std::string number_text(double value);

/// The table that every run has; its first two columns are the steps and their ends.
inline constexpr const char* iterations_file = "iterations.csv";

}  // namespace fsi
