#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace fsi {

/// What a column of a CSV table may measure.
enum class ColumnKind { time, pressure, flow_rate, flow_rate_of_depth, elastance };

/// A unit that the header of a column names.
struct ColumnUnit {
  std::string name;   ///< as in the header
  double factor = 1;  ///< from this unit to ms, kPa, mm^3/ms, mm^2/ms or kPa/mm^3
};

/// The unit in the header of a column: behind underscores or blanks ("flow_ml_per_s", "time ms"), in brackets
/// ("flow [L/min]"), or alone ("mmHg"). Empty when it names none. `_per_` is the same as `/`, and `^` may be left out.
/// \throws std::invalid_argument with the problem: the unit of something else, or an unknown one
std::optional<ColumnUnit> column_unit(std::string_view header, ColumnKind kind);

/// "ms, s, us or min", for messages.
std::string known_units(ColumnKind kind);

}  // namespace fsi
