#pragma once

#include <string>
#include <vector>

namespace fsi {

inline constexpr double pascal_per_kilopascal = 1000.0;  ///< tables show pressures in Pa

/// What numbers of a level measure. A restart compares numbers of one measure relative to the largest of them, since
/// small ones may be rounding alone.
enum class Measure {
  none,  ///< not compared: places, and numbers that do not follow from the state
  displacement,
  velocity,
  flow,
  area,
  pressure
};

/// A column of a table of records: its name, which ends with the unit, and its number in that unit.
template <class Record>
struct Column {
  const char* name;
  double (*value)(const Record& record);
  Measure measure = Measure::none;
  bool (*exists)(const Record& record) = nullptr;  ///< whether the record has such a number; null: all have
};

template <class Record>
using Columns = std::vector<Column<Record>>;

/// \param lead  what stands before the columns: "time_ms" or "step,time_ms", maybe with a column of names
template <class Record>
std::string header_of(std::string lead, const Columns<Record>& columns) {
  for (const auto& column : columns) lead += std::string(",") + column.name;
  return lead;
}

}  // namespace fsi
