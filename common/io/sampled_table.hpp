#pragma once

#include <optional>
#include <string>
#include <vector>

namespace fsi {

/// A table with the same named samples at each level of time: `time_ms,NAME,...` with a column of names behind the time,
/// then where the sample is, then its values. A value that does not exist there is an empty cell.
struct SampledTable {
  std::string file;
  std::string header;
  std::vector<std::string> places;  ///< per row of a level, the cells between its time and its values, as text
  /// Per column of values, which of them share a unit: they are compared by the largest of all.
  std::vector<int> kinds;
};

/// A row's values, as many as the table has kinds; in the tables' units.
using SampledRow = std::vector<std::optional<double>>;

/// Files that such tables may have.
inline constexpr const char* points_file = "points.csv";
inline constexpr const char* lines_file = "lines.csv";
inline constexpr const char* planes_file = "planes.csv";

/// The rows of a level as they stand in the file. \throws ConvergenceError when a number is not finite
std::string sampled_text(const SampledTable& table, double time, const std::vector<SampledRow>& rows);

/// A number as the tables show it: the fewest digits that read back to the same double.
std::string number_text(double value);

}  // namespace fsi
