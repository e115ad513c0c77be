#include "case/windkessel_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "case/case_entry.hpp"
#include "case/openings.hpp"

namespace fsi {

namespace {

constexpr double kilopascal = 0.133322;  // 1 mmHg in kPa, and 1 mmHg s/ml in kPa ms/mm^3, since 1 ml/s is 1 mm^3/ms
constexpr double millilitres = 1e3 / kilopascal;  // 1 ml/mmHg in mm^3/kPa

constexpr double unusual = 20;  // kPa: more than is found in arteries at rest

/// The largest initial pressure that the case gives for prestress and laws, kPa.
double given_pressure(const Case& scene) {
  double pressure = scene.prestress ? scene.prestress->pressure : 0;
  for (const auto& [surface, conditions] : scene.openings) {
    if (!conditions.law) continue;
    const auto law = conditions.law->make();
    if (const auto kept = law->start(); !kept.empty()) pressure = std::max(pressure, law->pressure_behind(kept.data()));
  }
  return pressure;
}

/// Too high for a vessel, or higher than what the case gives by about the ratio of kPa to mmHg.
bool too_high(double pressure, double given) {
  if (const auto slip = unit_slip(quantity::pressure(), pressure); slip && std::string(slip->unit) == "mmHg")
    return true;
  return pressure > unusual && given > 0 && pressure * kilopascal > given / 1.5 && pressure * kilopascal < 1.5 * given;
}

/// Much shorter than a beat, and comparable to one as a number of seconds.
bool too_short(double time_constant, double beat) {
  return time_constant < 0.01 * beat && 1e3 * time_constant > 0.1 * beat;
}

/// What the time constant is compared with, ms, and its name.
struct Beat {
  double length;
  const char* name;
};

/// The longest period; without any the run. That says less, so that it does not count if the pressure is plausible.
std::optional<Beat> beat_of(const Case& scene, bool pressure_is_right) {
  double period = 0;
  for (const auto& [key, table] : tables_over_time(scene)) period = std::max(period, table->period);
  if (period > 0) return Beat{period, "period"};
  if (pressure_is_right) return std::nullopt;
  return Beat{scene.time->end, "run"};
}

}  // namespace

std::optional<double> mean_pressure_of_flow(const Case& scene) {
  double flow = 0, conductance = 0, behind = 0;
  for (const auto& opening : openings_of(scene)) {
    if (opening.flow_rate) {
      const auto& table = opening.flow_rate->table;
      flow += table.mean(0, table.period > 0 ? table.period : scene.time->end);
    } else if (opening.law) {
      const auto law = opening.law->make();
      const double resistance = law->slope(0);  // to a steady flow
      if (!(resistance > 0)) return std::nullopt;
      conductance += 1 / resistance;
      behind += law->pressure(0, law->start().data(), 0) / resistance;
    } else if (opening.demanded) {
      return std::nullopt;
    }
  }
  if (!(flow > 0) || !(conductance > 0)) return std::nullopt;
  return (flow + behind) / conductance;
}

void warn_of_windkessel_units(const CaseEntry& whole_case, const Case& scene) {
  if (!scene.fluid || !scene.time) return;
  const auto pressure = mean_pressure_of_flow(scene);
  const bool high = pressure && too_high(*pressure, given_pressure(scene));
  bool said_high = false;
  for (const auto& [surface, conditions] : scene.openings) {
    if (!conditions.law) continue;
    const CaseEntry entry = whole_case.child("opening").child(surface).child(conditions.law->name);
    if (high && !said_high)
      entry.warn(fmt::format("the mean flow would raise {:.3g} kPa behind the outlets, as resistances in mmHg s/ml do",
                             *pressure),
                 fmt::format("multiply such resistances by {}: kPa ms/mm^3 are expected", kilopascal));
    said_high = said_high || high;
    const auto beat = beat_of(scene, pressure && !high);
    const double time_constant = conditions.law->make()->time_constant();
    if (!beat || time_constant == 0 || !too_short(time_constant, beat->length)) continue;
    const std::string problem =
        fmt::format("distal times compliance is {:.3g} ms beside {:g} ms of a {}, which looks like a number of seconds",
                    time_constant, beat->length, beat->name);
    if (pressure && !high)
      entry.warn(problem,
                 fmt::format("multiply a compliance in ml/mmHg by {:.6g}: mm^3/kPa are expected", millilitres));
    else
      entry.warn(problem,
                 fmt::format("multiply resistances in mmHg s/ml by {} and compliances in ml/mmHg by {:.6g}: kPa "
                             "ms/mm^3 and mm^3/kPa are expected",
                             kilopascal, millilitres));
  }
}

}  // namespace fsi
