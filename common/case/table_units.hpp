#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace fsi {

/// What a column of a CSV table may measure.
enum class ColumnKind { time, pressure, flow_rate, flow_rate_of_depth, elastance };

/// A unit that the header of a column names.
struct ColumnUnit {
  std::string name;   ///< as it stands in the header
  double factor = 1;  ///< a value in it times this is one in ms, kPa, mm^3/ms, mm^2/ms or kPa/mm^3
};

/// The unit in the header of a column: behind the last underscores or blanks ("flow_ml_per_s", "time ms"), in brackets
/// ("flow [L/min]"), or alone ("mmHg"). Empty when it names none. Spellings with `_per_` and with `/`, with and without `^`
/// are alike.
/// \throws std::invalid_argument whose text says what is wrong: the unit of something else, or an unknown one
std::optional<ColumnUnit> column_unit(std::string_view header, ColumnKind kind);

/// "ms, s, us or min", for messages.
std::string known_units(ColumnKind kind);

}  // namespace fsi
