#include "fields/point_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <sstream>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "base/names.hpp"
#include "fields/field_units.hpp"

namespace fsi {

namespace {

std::vector<std::string> columns_of(const std::string& line) {
  std::vector<std::string> columns;
  std::istringstream in(line);
  for (std::string column; std::getline(in, column, ',');) {
    const auto first = column.find_first_not_of(" \t\r\""), last = column.find_last_not_of(" \t\r\"");
    columns.push_back(first == std::string::npos ? "" : column.substr(first, last - first + 1));
  }
  return columns;
}

/// The unit behind a column's name: "x_cm", "x [cm]", "x (cm)"; an empty text: none; nullopt: it is another name.
std::optional<std::string> unit_behind(const std::string& header, const std::string& name) {
  if (header.rfind(name, 0) != 0) return std::nullopt;
  std::string behind = header.substr(name.size());
  if (behind.empty()) return behind;
  if (std::string("_ [(").find(behind.front()) == std::string::npos) return std::nullopt;
  const bool in_brackets = behind.find_first_of("[(") != std::string::npos;
  for (const char nothing : {'_', ' ', '[', ']', '(', ')'})
    behind.erase(std::remove(behind.begin(), behind.end(), nothing), behind.end());
  // Without brackets it may be part of another name.
  const std::vector<std::string> known{"kPa",      "Pa",    "MPa",  "mmHg", "dyn/cm2",
                                       "dyn/cm^2", "N/mm2", "N/m2", "deg",  "rad"};
  if (!in_brackets && !length_unit(behind) && !contains(known, behind)) return std::nullopt;
  return behind;
}

/// Index of a column: the one of this name, else the first with a unit behind it; names.size(): there is none.
std::size_t place_of_column(const std::vector<std::string>& names, const std::string& wanted, std::string& unit) {
  const auto exact = std::find(names.begin(), names.end(), wanted);
  if (exact != names.end()) return static_cast<std::size_t>(exact - names.begin());
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const auto found = unit_behind(names[i], wanted)) {
      unit = *found;
      return i;
    }
  return names.size();
}

/// The unit of a coordinate in mm; an empty one is mm. \throws InputError
double length_of(const std::string& unit, const std::string& column, const std::string& file) {
  if (unit.empty()) return 1;
  if (const auto length = length_unit(unit)) return *length;
  throw InputError(file, "column " + column, unit + " is no known unit of length", "there are " + known_length_units());
}

/// Rows of the named columns; the fourth, if there is one, may have empty cells.
/// \param units  of the columns, as the first line says them
std::vector<std::vector<double>> rows_of(const std::string& text, const std::vector<std::string>& wanted,
                                         const std::string& file, const std::string& remedy,
                                         std::vector<std::string>& units) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  drop_byte_order_mark(line);
  const auto names = columns_of(line);
  std::vector<std::size_t> at;
  std::vector<double> factors(wanted.size(), 1.0);
  units.assign(wanted.size(), "");
  for (const auto& name : wanted) {
    const std::size_t k = at.size();
    at.push_back(place_of_column(names, name, units[k]));
    if (k < 3) factors[k] = length_of(units[k], name, file);
    if (at.back() == names.size())
      throw InputError(file, "column " + name, "is missing",
                       fmt::format("its first line must name {}", fmt::join(wanted, ", ")));
  }
  std::vector<std::vector<double>> rows;
  for (int number = 2; std::getline(in, line); ++number) {
    const auto cells = columns_of(line);
    if (cells.empty()) continue;
    auto& row = rows.emplace_back();
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      const std::string cell = at[k] < cells.size() ? cells[at[k]] : "";
      char* end = nullptr;
      row.push_back(std::strtod(cell.c_str(), &end));
      const bool is_hole = k == 3 && cell.empty();
      if (is_hole) row.back() = std::numeric_limits<double>::quiet_NaN();
      if ((end == cell.c_str() || *end != '\0' || (k < 3 && !std::isfinite(row.back()))) && !is_hole)
        throw InputError(file, fmt::format("line {}, {}", number, wanted[k]), "'" + cell + "' is no number",
                         k < 3 ? "give it in mm" : remedy);
      row.back() *= factors[k];
    }
  }
  if (rows.size() < 2) throw InputError(file, "", fmt::format("holds {} points", rows.size()), "give two or more");
  return rows;
}

}  // namespace

PointTable point_table(const std::string& text, const std::string& column, const std::string& file,
                       const std::string& remedy) {
  PointTable table;
  std::vector<std::string> units;
  for (const auto& row : rows_of(text, {"x", "y", "z", column}, file, remedy, units)) {
    table.places.push_back({row[0], row[1], row[2]});
    table.values.push_back(row[3]);
  }
  table.unit = units[3];
  for (int k = 0; k < 3 && table.length_unit.empty(); ++k) table.length_unit = units[k];
  return table;
}

std::vector<Point> polyline_of(const std::string& text, const std::string& file, std::string& length_unit) {
  std::vector<Point> line;
  std::vector<std::string> units;
  for (const auto& row : rows_of(text, {"x", "y", "z"}, file, "", units)) line.push_back({row[0], row[1], row[2]});
  length_unit.clear();
  for (int k = 0; k < 3 && length_unit.empty(); ++k) length_unit = units[k];
  return line;
}

}  // namespace fsi
