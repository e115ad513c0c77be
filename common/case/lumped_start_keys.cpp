#include "case/lumped_start_keys.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "case/openings.hpp"
#include "case/scene_period.hpp"
#include "openings/lumped_start.hpp"

namespace fsi {

namespace {

/// Keys of what a law keeps, in its order (OpeningLaw::start).
std::vector<std::string> initial_keys(const OpeningLawData& law) {
  std::vector<std::string> keys;
  for (const auto& parameter : opening_laws().at(law.name).parameters)
    if (parameter.name.rfind("initial_", 0) == 0) keys.push_back(parameter.name);
  return keys;
}

}  // namespace

void set_lumped_start(const CaseEntry& whole_case, Case& scene) {
  if (!scene.time || scene.time->start != StartOfOpenings::lumped) return;
  const CaseEntry start = whole_case.child("time").child("start");
  LumpedVessel vessel;
  vessel.period = scene.time->period ? *scene.time->period : require_period(start, scene, "time.period");
  const std::vector<OpeningData> openings = openings_of(scene);
  const PressureTable none;
  std::vector<const PressureTable*> pressures, flows;
  std::vector<std::string> keeping;  // surfaces whose laws keep something
  std::vector<std::size_t> numbers;  // and the indices of these laws
  for (const OpeningData& opening : openings) {
    if (opening.pressure) pressures.push_back(&*opening.pressure);
    if (opening.is_free() && opening.demanded) pressures.push_back(&none);
    if (opening.flow_rate) flows.push_back(&opening.flow_rate->table);
    if (!opening.law) continue;
    vessel.laws.push_back(opening.law->make());
    if (vessel.laws.back()->start().empty()) continue;
    const CaseEntry law = whole_case.child("opening").child(opening.surface).child(opening.law->name);
    for (const std::string& key : initial_keys(*opening.law))
      if (law.has(key)) law.child(key).refuse("is found by time.start = \"lumped\"", "leave one of the two out");
    keeping.push_back(opening.surface);
    numbers.push_back(vessel.laws.size() - 1);
  }
  if (keeping.empty()) start.refuse("is for a Windkessel, and no opening has one", "leave it out");
  if (pressures.size() + (flows.empty() ? 0 : 1) != 1)
    start.refuse(fmt::format("needs one opening whose pressure is given, or flows, and the case has {} and {}",
                             pressures.size(), flows.size()),
                 "give initial_pressure of each Windkessel in its place");
  if (flows.empty())
    vessel.pressure = [&](double time) { return pressures.front()->at(time); };
  else
    vessel.inflow = [&](double time) {
      double flow = 0;
      for (const auto* table : flows) flow += table->at(time);
      return flow;
    };
  const auto found = periodic_start(vessel);
  for (std::size_t i = 0; i < keeping.size(); ++i) {
    const std::vector<double>& kept = found[numbers[i]];
    OpeningLawData& law = *scene.openings.at(keeping[i]).law;
    const std::vector<std::string> keys = initial_keys(law);
    for (std::size_t k = 0; k < keys.size(); ++k) law.values[keys[k]] = kept[k];
    start.remark(fmt::format("{} starts from {:.6g} kPa behind it, of the periodic state of the openings alone",
                             keeping[i], law.make()->pressure_behind(kept.data())));
  }
}

}  // namespace fsi
