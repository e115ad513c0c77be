#include "io/sampled_table.hpp"

#include <fmt/format.h>

#include <cassert>

#include "base/finite.hpp"

namespace fsi {

std::string number_text(double value) {
  return fmt::format("{}", value);
}

std::string sampled_text(const SampledTable& table, double time, const std::vector<SampledRow>& rows) {
  assert(rows.size() == table.places.size());
  std::string text;
  const std::string at = number_text(time);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    assert(rows[i].size() == table.kinds.size());
    text += at + ',' + table.places[i];
    for (const auto& value : rows[i]) {
      text += ',';
      if (!value) continue;
      require_finite({*value}, "a number of " + table.file);
      text += number_text(*value);
    }
    text += '\n';
  }
  return text;
}

}  // namespace fsi
