#pragma once

#include <string>
#include <vector>

namespace fsi {

inline constexpr double pascal_per_kilopascal = 1000.0;  ///< tables show pressures in Pa

/// What numbers of a level measure. A restart compares those of one measure by the largest of them, since small ones may
/// be rounding alone.
enum class Measure {
  none,  ///< not compared: places, and what is no state's
  displacement,
  flow,
  pressure
};

/// A column of a table of records: its name, which ends with the unit, and its number in that unit.
template <class Record>
struct Column {
  const char* name;
  double (*value)(const Record& record);
  Measure measure = Measure::none;
};

template <class Record>
using Columns = std::vector<Column<Record>>;

/// \param lead  what stands before the columns: "time_ms" or "step,time_ms", maybe with a column of names
template <class Record>
std::string header_of(std::string lead, const Columns<Record>& columns) {
  for (const auto& column : columns) lead += std::string(",") + column.name;
  return lead;
}

/// \param row  the numbers before the columns
template <class Record>
std::vector<double> row_of(std::vector<double> row, const Columns<Record>& columns, const Record& record) {
  row.reserve(row.size() + columns.size());
  for (const auto& column : columns) row.push_back(column.value(record));
  return row;
}

/// A row for each record.
template <class Record>
std::vector<std::vector<double>> rows_of(const std::vector<double>& lead, const Columns<Record>& columns,
                                         const std::vector<Record>& records) {
  std::vector<std::vector<double>> rows;
  rows.reserve(records.size());
  for (const Record& record : records) rows.push_back(row_of(lead, columns, record));
  return rows;
}

}  // namespace fsi
