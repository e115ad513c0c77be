#include "observers/same_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"

namespace fsi {

namespace {

constexpr double same_state = 1e-6;  // relative: what programs of different compilers may make of one state

/// How far numbers of two origins lie apart, and the largest of them.
struct Agreement {
  double apart = 0, size = 0;

  void include(double a, double b) {
    size = std::max({size, std::abs(a), std::abs(b)});
    apart = std::max(apart, std::abs(a - b));
  }
};

}  // namespace

void require_same_rows(const EarlierTables& earlier, const ResultTable& table, double time,
                       const std::vector<TableRow>& seen) {
  const auto& before = earlier.last_level(table.file);
  if (before.empty()) return;
  const std::size_t width = table.measures.size();
  std::map<Measure, Agreement> by_measure;
  for (std::size_t i = 0; i < seen.size() * width; ++i) {
    const Measure measure = table.measures[i % width];
    if (measure == Measure::none) continue;
    const auto& now = seen[i / width].at(i % width);
    Agreement& found = by_measure[measure];
    if (std::isnan(before.at(i)) != !now.has_value())  // an empty place in one of them only
      found.apart = HUGE_VAL;
    else if (now)
      found.include(before.at(i), *now);
  }
  for (const auto& [measure, found] : by_measure) {
    if (found.apart <= same_state * found.size) continue;
    throw InputError(
        (earlier.folder() / table.file).string(), "",
        fmt::format("its rows of the time {:g} differ from the checkpoint's state by {:.1e} of their largest "
                    "value: the two are not of one run",
                    time, found.apart / found.size),
        "restart from a folder as its run has left it, or run from the start");
  }
}

}  // namespace fsi
