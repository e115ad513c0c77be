#include "case/periodic_end.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "case/scene_period.hpp"

namespace fsi {

namespace {

constexpr double most_percent = 50;

/// Reads "until 1%".
void read_periods(const CaseEntry& entry, TimeData& time) {
  const std::string remedy = "give \"until 1%\", or another share; for a number of periods give time.end";
  if (!entry.is_text()) entry.refuse("is not a text", remedy);
  const std::string text = entry.text(), word = "until ";
  char* rest = nullptr;
  const char* number = text.c_str() + (text.rfind(word, 0) == 0 ? word.size() : text.size());
  const double percent = std::strtod(number, &rest);
  while (*rest == ' ') ++rest;
  if (rest == number || std::string(rest) != "%") entry.refuse("\"" + one_line(text) + "\" is unknown", remedy);
  if (!(percent > 0 && percent <= most_percent))
    entry.refuse(fmt::format("{:g} % is not above 0 and at most {:g}", percent, most_percent), remedy);
  time.periodic_change = percent / 100;
}

}  // namespace

CaseKey<TimeData> periods_key() {
  return leaf<TimeData>("periods", presence::optional,
                        "\"until 1%\": ends the run before `end`, once pressures, flows and displacements change by no "
                        "more than that from one period to the next, and are no farther from the periodic state",
                        {read_periods,
                         [](const TimeData& time) {
                           return time.periodic_change ? fmt::format("until {:.12g}%", 100 * *time.periodic_change)
                                                       : std::string("to the end");
                         }},
                        KeyRole::running);
}

void check_periodic_end(const CaseEntry& whole_case, Case& scene) {
  if (!scene.time) return;
  TimeData& time = *scene.time;
  const CaseEntry section = whole_case.child("time");
  if (!time.periodic_change) {
    if (time.period && time.start != StartOfOpenings::lumped)
      section.child("period").refuse("belongs to periods and start = \"lumped\"",
                                     "add periods = \"until 1%\", or leave it out");
    return;
  }
  const CaseEntry periods = section.child("periods");
  if (!scene.fluid) periods.refuse("are of a fluid, and the scene has none", "leave them out");
  if (!time.period) time.period = require_period(periods, scene, "time.period");
  if (3 * *time.period > time.end)
    section.child("end").refuse(fmt::format("{:g} ms is less than three periods of {:g} ms, whose changes are compared",
                                            time.end, *time.period),
                                fmt::format("give at least {:g}", 3 * *time.period));
  if (time.end > TimeData::most_steps * *time.period)
    section.child("end").refuse(
        fmt::format("{:g} ms are more than a million periods of {:g} ms", time.end, *time.period),
        fmt::format("give at most {:g}", TimeData::most_steps * *time.period));
}

}  // namespace fsi
