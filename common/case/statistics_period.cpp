#include "case/statistics_period.hpp"

#include <fmt/format.h>

#include "case/openings.hpp"

namespace fsi {

std::vector<std::pair<std::string, double>> periods_of_openings(const Case& setup) {
  std::vector<std::pair<std::string, double>> periods;
  for (const auto& [key, table] : tables_over_time(setup))
    if (table->period > 0) periods.emplace_back(key, table->period);
  return periods;
}

std::string about_statistics(const Case& setup) {
  const auto& wanted = setup.output.derived;
  if (!wanted.statistics || !wanted.period) return "";
  std::vector<std::string> of;
  for (const auto& [key, period] : periods_of_openings(setup))
    if (period == *wanted.period) of.push_back(key);
  return fmt::format("statistics over periods of {:g} ms{}", *wanted.period,
                     of.empty() ? "" : fmt::format(", that of {}", fmt::join(of, ", ")));
}

}  // namespace fsi
