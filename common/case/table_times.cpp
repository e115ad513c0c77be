#include "case/table_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "case/network_data.hpp"
#include "case/openings.hpp"

namespace fsi {

namespace {

constexpr double least_ratio = 500, largest_ratio = 2000;  // of a second to what is taken for a millisecond
constexpr std::size_t rows_of_a_course = 4;                // fewer make a pulse, which may be as short as a step
constexpr double long_step = 100;                          // ms
constexpr double steps_of_a_period = 5;

struct NamedTable {
  CaseEntry entry;
  const PressureTable* table;
};

/// All tables over time of a case, with their entries.
std::vector<NamedTable> tables_of(const CaseEntry& whole_case, const Case& scene) {
  std::vector<NamedTable> tables;
  if (scene.inlet) tables.push_back({whole_case.child("inlet").child("pressure"), &*scene.inlet});
  if (scene.load) tables.push_back({whole_case.child("load").child("pressure"), &*scene.load});
  for (const auto& [surface, conditions] : scene.openings) {
    const CaseEntry entry = whole_case.child("opening").child(surface);
    if (conditions.pressure) tables.push_back({entry.child("pressure"), &*conditions.pressure});
    if (conditions.flow_rate) tables.push_back({entry.child("flow_rate"), &conditions.flow_rate->table});
  }
  for (const auto& [surface, support] : scene.supports) {
    const CaseEntry entry = whole_case.child("support").child(surface);
    if (support.pressure) tables.push_back({entry.child("pressure"), &*support.pressure});
    if (!support.traction.empty()) tables.push_back({entry.child("traction"), &support.traction.front()});
  }
  if (scene.network)
    for (const auto& element : scene.network->elements)
      if (element.course)
        tables.push_back({whole_case.child("network").child("element").child(element.name), &*element.course});
  return tables;
}

/// The sign that a table's times are in seconds; empty: there is none.
std::string sign_of_seconds(const PressureTable& table, const TimeData& time) {
  const double last = table.points.back().first;
  if (!(last > 0)) return "";
  if (table.period > 0) {
    const double ratio = table.period / last;
    return ratio >= least_ratio && ratio <= largest_ratio
               ? fmt::format("ends at {:g} ms beside a period of {:g} ms", last, table.period)
               : "";
  }
  if (table.points.size() < rows_of_a_course || last * least_ratio > time.end) return "";
  if (time.adaptive) return fmt::format("ends at {:g} ms of a run of {:g} ms", last, time.end);
  return last <= time.step ? fmt::format("ends at {:g} ms, within the first step of {:g} ms", last, time.step) : "";
}

}  // namespace

void warn_of_table_times(const CaseEntry& whole_case, const Case& scene) {
  if (!scene.time) return;
  double shortest_period = 0;
  for (const auto& [entry, table] : tables_of(whole_case, scene)) {
    const bool doubted = entry.is_array() && unit_slip(quantity::time(), table->points.back().first);  // row by row
    if (const std::string sign = sign_of_seconds(*table, *scene.time); !sign.empty() && !doubted)
      entry.warn(
          fmt::format("the table {}: its times look like seconds", sign),
          "times are in ms; or say so: time_s in the header of a file, or time_unit = \"s\" beside file or rows");
    if (table->period > 0 && (shortest_period == 0 || table->period < shortest_period)) shortest_period = table->period;
  }
  const double step = scene.time->step;
  if (scene.time->adaptive || step < long_step || shortest_period == 0) return;
  if (step * steps_of_a_period > shortest_period)
    whole_case.child("time").child("step").warn(
        fmt::format("{:g} ms are {:.3g} of the period of {:g} ms, which looks like a step in us", step,
                    step / shortest_period, shortest_period),
        fmt::format("did you mean {:.3g} ms?", step / 1000));
}

}  // namespace fsi
