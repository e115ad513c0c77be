#include "mesh/fields/point_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>

#include "base/error.hpp"

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

/// Rows of the named columns; the fourth, if there is one, may have empty cells.
std::vector<std::vector<double>> rows_of(const std::string& text, const std::vector<std::string>& wanted,
                                         const std::string& file, const std::string& remedy) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  const auto names = columns_of(line);
  std::vector<std::size_t> at;
  for (const auto& name : wanted) {
    at.push_back(static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin()));
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
    }
  }
  if (rows.size() < 2) throw InputError(file, "", fmt::format("holds {} points", rows.size()), "give two or more");
  return rows;
}

}  // namespace

PointTable point_table(const std::string& text, const std::string& column, const std::string& file,
                       const std::string& remedy) {
  PointTable table;
  for (const auto& row : rows_of(text, {"x", "y", "z", column}, file, remedy)) {
    table.places.push_back({row[0], row[1], row[2]});
    table.values.push_back(row[3]);
  }
  return table;
}

std::vector<Point> polyline_of(const std::string& text, const std::string& file) {
  std::vector<Point> line;
  for (const auto& row : rows_of(text, {"x", "y", "z"}, file, "")) line.push_back({row[0], row[1], row[2]});
  return line;
}

}  // namespace fsi
