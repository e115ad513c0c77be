#include "io/result_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/finite.hpp"

namespace fsi {

std::size_t ResultTable::rows() const {
  return std::max({std::size_t{1}, names.size(), places.size()});
}

std::string number_text(double value) {
  return fmt::format("{}", value);
}

std::string text_of(const ResultTable& table, const TableRows& found) {
  assert(table.names.empty() || found.rows.size() == table.names.size());
  std::string text;
  for (std::size_t i = 0; i < found.rows.size(); ++i) {
    text += fmt::format("{}", fmt::join(found.lead, ","));
    if (!table.names.empty()) text += ',' + table.names[i];
    for (const auto& value : found.rows[i]) {
      text += ',';
      if (!value) continue;
      if (!std::isfinite(*value)) require_finite({*value}, "a number of " + table.file);
      text += number_text(*value);
    }
    text += '\n';
  }
  return text;
}

}  // namespace fsi
