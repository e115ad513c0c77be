#include "case/scene_period.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "case/case_entry.hpp"
#include "case/network_data.hpp"
#include "case/openings.hpp"
#include "time/fitting_step.hpp"

namespace fsi {

std::vector<std::pair<std::string, double>> periods_of_openings(const Case& setup) {
  std::vector<std::pair<std::string, double>> periods;
  for (const auto& [key, table] : tables_over_time(setup))
    if (table->period > 0) periods.emplace_back(key, table->period);
  for (auto& period : periods_of_network(setup)) periods.push_back(std::move(period));
  return periods;
}

namespace {

constexpr double same_phase = 1e-3;  // of a step

/// "800 ms, that of opening.inlet.flow_rate"
std::string period_with_owners(const Case& setup, double wanted) {
  std::vector<std::string> of;
  for (const auto& [key, period] : periods_of_openings(setup))
    if (period == wanted) of.push_back(key);
  return fmt::format("{:g} ms{}", wanted, of.empty() ? "" : fmt::format(", that of {}", fmt::join(of, ", ")));
}

}  // namespace

double require_period(const CaseEntry& asking, const Case& setup, const char* key) {
  const std::string remedy = fmt::format("give {} in ms", key);
  const auto periods = periods_of_openings(setup);
  if (periods.empty()) asking.refuse("need a period, and no opening is periodic", remedy);
  for (const auto& [name, period] : periods)
    if (period != periods.front().second)
      asking.refuse(fmt::format("need a period, and the openings have different ones: {} of {:g} ms, {} of {:g} ms",
                                periods.front().first, periods.front().second, name, period),
                    remedy);
  return periods.front().second;
}

std::string about_statistics(const Case& setup) {
  const auto& wanted = setup.output.derived;
  if (!wanted.statistics || !wanted.period) return "";
  return "statistics over periods of " + period_with_owners(setup, *wanted.period);
}

std::string about_steps_of_periods(const Case& setup) {
  if (!setup.time || !setup.time->period) return "";
  const TimeData& time = *setup.time;
  if (time.adaptive) return "adaptive steps fall on other phases in each period";
  const double steps = *time.period / time.step;
  if (std::abs(steps - std::round(steps)) <= same_phase) return "";
  // Steps end at jumps and begin anew.
  for (const auto& [key, table] : tables_over_time(setup))
    if (table->period == *time.period && table->jumps_in_period() > 0) return "";
  const double fits = fitting_step(*time.period, time.step);
  return fmt::format(
      "a period of {:g} ms is no whole number of steps of {:g} ms, so that steps see kinks of the tables at other "
      "places "
      "in each; time.step = {:.12g} fits ({:.0f} a period)",
      *time.period, time.step, fits, *time.period / fits);
}

std::string about_periodic_end(const Case& setup) {
  if (!setup.time || !setup.time->periodic_change) return "";
  const TimeData& time = *setup.time;
  const std::string steps = about_steps_of_periods(setup);
  return fmt::format(
      "the run ends before {:g} ms once pressures, flows and displacements differ by at most {:g} % of their ranges "
      "from those one period before, and their means from those of the periodic state; periods of {}{}",
      time.end, 100 * *time.periodic_change, period_with_owners(setup, *time.period),
      time.adaptive || steps.empty() ? "" : "; " + steps);
}

}  // namespace fsi
