#include "case/table_input.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/input_file.hpp"

namespace fsi {

namespace {

constexpr const char *time_unit_key = "time_unit", *value_unit_key = "value_unit";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string_view::npos ? std::string_view() : text.substr(first, last - first + 1);
}

/// A finite number within CaseEntry's limits, and nothing else.
std::optional<double> number_of(std::string_view text) {
  text = trimmed(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  if (value != 0 && !(std::abs(value) >= smallest_size && std::abs(value) <= largest_size)) return std::nullopt;
  return value;
}

std::optional<std::pair<double, double>> row_of(std::string_view line) {
  const auto comma = line.find_first_of(",;");
  if (comma == std::string_view::npos) return std::nullopt;
  const auto time = number_of(line.substr(0, comma)), value = number_of(line.substr(comma + 1));
  if (!time || !value) return std::nullopt;
  return std::pair{*time, *value};
}

/// The units that a header names; without any, ms and that of the kind.
struct ColumnFactors {
  double time = 1, value = 1;
  bool time_named = false, value_named = false;
};

/// The unit that a key beside the table names. \throws InputError
std::optional<ColumnUnit> unit_of_key(const CaseEntry& entry, const char* key, ColumnKind kind) {
  if (!entry.has(key)) return std::nullopt;
  const CaseEntry given = entry.child(key);
  const std::string word = given.line();
  std::string problem = "is no known unit";
  try {
    if (auto unit = column_unit(word, kind)) return unit;
  } catch (const std::invalid_argument& wrong) {
    problem = wrong.what();
  }
  given.refuse_name(problem, "give " + known_units(kind));
}

/// The conversions in words; empty: none.
std::string text_of_factors(const std::optional<ColumnUnit>& time, const std::optional<ColumnUnit>& value,
                            const TableKind& kind) {
  std::string said;
  if (time && time->factor != 1) said += fmt::format("times in {}, times {:g} in ms", time->name, time->factor);
  if (value && value->factor != 1)
    said += fmt::format("{}{} in {}, times {:.6g} in {}", said.empty() ? "" : "; ", kind.plural, value->name,
                        value->factor, kind.values.unit);
  return said;
}

/// The factors from the units that header and keys name. \param section  of the key `file`
/// \param refuse  called with problem and remedy
template <class Refuse>
ColumnFactors factors_of(std::string_view header, const CaseEntry& section, const TableKind& kind, Refuse refuse) {
  const auto comma = header.find_first_of(",;");
  const std::string_view columns[] = {trimmed(header.substr(0, comma)), trimmed(header.substr(comma + 1))};
  std::optional<ColumnUnit> units[2];
  for (int i = 0; i < 2; ++i) {
    const ColumnKind wanted = i == 0 ? ColumnKind::time : kind.column;
    try {
      units[i] = column_unit(columns[i], wanted);
    } catch (const std::invalid_argument& wrong) {
      refuse(fmt::format("column {}: {}", i + 1, wrong.what()),
             fmt::format("give it in {}: {}", i == 0 ? "ms" : kind.values.unit, known_units(wanted)));
    }
    const char* key = i == 0 ? time_unit_key : value_unit_key;
    const auto told = unit_of_key(section, key, wanted);
    if (told && units[i] && told->factor != units[i]->factor)
      refuse(fmt::format("column {} is in {}, but {} = \"{}\"", i + 1, units[i]->name, key, told->name),
             fmt::format("leave {} out, or mend the header", key));
    if (told) units[i] = told;
  }
  ColumnFactors factors;
  if (units[0]) factors.time = units[0]->factor;
  if (units[1]) factors.value = units[1]->factor;
  factors.time_named = units[0].has_value();
  factors.value_named = units[1].has_value();
  const std::string said = text_of_factors(units[0], units[1], kind);
  if (!said.empty()) section.child("file").remark("the file has " + said);
  return factors;
}

void read_file(const CaseEntry& section, const TableKind& kind, TableInput& input) {
  const CaseEntry entry = section.child("file", "path of a CSV file");
  const auto file = entry.path("path of a CSV file");
  const std::string remedy =
      fmt::format("give a CSV file with a header and two columns, time in ms and {} in {}", kind.key, kind.values.unit);
  try {
    require_regular_file(file, {"no such file", remedy.c_str(), remedy.c_str(), 64 << 20});
  } catch (const InputError& problem) {
    const std::string_view said = problem.what();  // the file, what is wrong, and the remedy
    entry.refuse(fmt::format("cannot be read: {}", said.substr(0, said.rfind("; " + remedy))), remedy);
  }
  std::ifstream stream(file);
  if (!stream) entry.refuse(fmt::format("\"{}\" cannot be read", file.string()), "check its permissions");
  auto& points = input.table.points;
  ColumnFactors factors;
  bool warned_of_value = false;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    const auto refuse = [&](const std::string& problem, const std::string& what_to_do) {
      throw InputError(fmt::format("{}:{}", file.string(), number), entry.key(), problem, what_to_do);
    };
    if (number == 1) drop_byte_order_mark(line);
    const auto row = row_of(line);
    if (number == 1) {
      if (row)
        refuse("the first line is a row of numbers", "put a header above it, like time_ms," + std::string(kind.key));
      if (line.find_first_of(",;") == std::string::npos) refuse("the first line is no header of two columns", remedy);
      factors = factors_of(line, section, kind, refuse);
      continue;
    }
    if (trimmed(line).empty()) continue;
    if (!row) refuse("is no row of two numbers", remedy);
    points.emplace_back(factors.time * row->first, factors.value * row->second);
    if (!factors.value_named && !warned_of_value) warned_of_value = entry.warn_of_unit(kind.values, row->second);
    if (points.size() > most_table_rows)
      refuse(fmt::format("a table of more than {} rows", most_table_rows),
             fmt::format("give at most {}", most_table_rows));
    check_last_row(points, [&](const std::string& problem, const std::string& what_to_do) {
      refuse(fmt::format("{} {}", trimmed(line), problem), what_to_do);
    });
  }
  if (points.empty()) entry.refuse(fmt::format("\"{}\" has no row below its header", file.string()), remedy);
}

/// Reads rows of the case file itself. \param factors  from their units
void read_rows(const CaseEntry& entry, const TableKind& kind, const ColumnFactors& factors, TableInput& input) {
  bool warned_of_time = factors.time_named, warned_of_value = factors.value_named;  // once is enough
  auto& points = input.table.points;
  for (const auto& row : rows_of_table(entry)) {
    const auto pair = row.is_array() ? row.elements() : std::vector<CaseEntry>{};
    if (pair.size() != 2) row.refuse_value("is no pair", fmt::format("give [time, {}]", kind.key));
    const double time = pair[0].number(), value = pair[1].number();
    points.emplace_back(factors.time * time, factors.value * value);
    if (!warned_of_time) warned_of_time = pair[0].warn_of_unit(quantity::time(), time);
    if (!warned_of_value) warned_of_value = pair[1].warn_of_unit(kind.values, value);
    check_last_row(points,
                   [&](const std::string& problem, const std::string& remedy) { row.refuse_value(problem, remedy); });
  }
  if (points.empty()) entry.refuse_name("is empty", fmt::format("give at least one row [time, {}]", kind.key));
}

/// Reads { file = NAME } or { rows = [...] }, with time_unit and value_unit if the numbers are in other units.
void read_section(const CaseEntry& entry, const TableKind& kind, TableInput& input) {
  refuse_unknown_keys(entry, {"file", "rows", time_unit_key, value_unit_key});
  input.is_table = true;
  if (entry.has("file") && entry.has("rows")) entry.child("rows").refuse("stands beside file", "keep one of the two");
  if (!entry.has("rows")) {
    if (!entry.has("file")) entry.refuse_missing("file", "add it (path of a CSV file), or rows");
    read_file(entry, kind, input);
    return;
  }
  const auto time = unit_of_key(entry, time_unit_key, ColumnKind::time);
  const auto value = unit_of_key(entry, value_unit_key, kind.column);
  ColumnFactors factors;
  if (time) factors.time = time->factor;
  if (value) factors.value = value->factor;
  factors.time_named = time.has_value();
  factors.value_named = value.has_value();
  read_rows(entry.child("rows"), kind, factors, input);
  if (const auto said = text_of_factors(time, value, kind); !said.empty()) entry.remark("the rows have " + said);
}

}  // namespace

const TableKind& pressure_kind() {
  static const TableKind kind{"pressure", "pressures", quantity::pressure(), ColumnKind::pressure};
  return kind;
}

const TableKind& flow_rate_kind(bool plane) {
  static const TableKind kind{"flow_rate", "flow rates", quantity::flow_rate(), ColumnKind::flow_rate};
  static const TableKind of_depth{"flow_rate", "flow rates", quantity::flow_rate(), ColumnKind::flow_rate_of_depth};
  return plane ? of_depth : kind;
}

std::vector<CaseEntry> rows_of_table(const CaseEntry& entry) {
  auto rows = entry.elements();
  if (rows.size() > most_table_rows)
    entry.refuse(fmt::format("a table of {} rows", rows.size()), fmt::format("give at most {}", most_table_rows));
  return rows;
}

void check_last_row(const std::vector<std::pair<double, double>>& points,
                    const std::function<void(const std::string& problem, const std::string& remedy)>& refuse) {
  const auto n = points.size();
  if (n > 1 && points[n - 1].first < points[n - 2].first)
    refuse(fmt::format("comes before the time {} of the row above", points[n - 2].first), "sort the table by time");
  if (n > 2 && points[n - 1].first == points[n - 3].first)
    refuse("is the third row with this time", "give two rows for a jump");
}

void read_table(const CaseEntry& entry, const TableKind& kind, bool with_file, TableInput& input) {
  if (with_file && entry.is_section()) {
    read_section(entry, kind, input);
    return;
  }
  input.is_table = entry.is_array();
  if (!input.is_table) {
    input.table.points = {{0.0, entry.number(kind.values)}};
    return;
  }
  read_rows(entry, kind, {}, input);
}

void read_until(const CaseEntry& entry, TableInput& input) {
  input.until = entry.number(quantity::time());
  if (!(*input.until > 0)) entry.refuse_value("is not positive", "give a time > 0");
}

void read_period(const CaseEntry& entry, TableInput& input) {
  input.period = entry.number(quantity::time());
  if (!(*input.period > 0)) entry.refuse_value("is not positive", "give a time > 0");
}

void finish_table(const CaseEntry& entry, const TableKind& kind, TableInput& input) {
  auto& points = input.table.points;
  if (input.until) {
    if (input.is_table)
      entry.child("until").refuse(fmt::format("stands beside a table of {}", kind.plural),
                                  fmt::format("remove it; the table says when the {} ends",
                                              std::string(kind.key) == "flow_rate" ? "flow rate" : kind.key));
    const double value = points.front().second;
    points = {{0.0, value}, {*input.until, value}, {*input.until, 0.0}};
  }
  if (!input.period) return;
  if (!input.is_table && !input.until)
    entry.child("period").refuse(fmt::format("stands beside a {} that never changes", kind.key),
                                 "remove it, or give a table");
  if (points.front().first < 0)
    entry.child("period").refuse(fmt::format("the table begins at {} ms", points.front().first),
                                 "let the table of a period begin at 0 or later");
  if (points.back().first > *input.period)
    entry.child("period").refuse(
        fmt::format("{} is shorter than the table, which ends at {} ms", *input.period, points.back().first),
        fmt::format("give at least {}, or a shorter table", points.back().first));
  input.table.period = *input.period;
}

void check_jumps(const CaseEntry& entry, const PressureTable& table, double end) {
  constexpr double most = 100'000;
  if (table.period == 0) return;
  const double jumps = static_cast<double>(table.jumps_in_period()) * end / table.period;
  if (jumps > most)
    entry.child("period").refuse(
        fmt::format("the table would jump {:.3g} times in {} ms, and end a step each time", jumps, end),
        "give a longer period, or a table without jumps whose last value is its first");
}

std::string text_of_table(const PressureTable& table) {
  std::vector<std::string> rows;
  for (const auto& [time, value] : table.points) rows.push_back(fmt::format("[{}, {}]", time, value));
  return fmt::format("[{}]", fmt::join(rows, ", "));
}

}  // namespace fsi
