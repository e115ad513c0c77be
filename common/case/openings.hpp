#pragma once

#include <string>
#include <utility>
#include <vector>

#include "case/case.hpp"
#include "mesh/group_names.hpp"

namespace fsi {

/// One surface through which fluid may pass, with what happens there.
struct OpeningData : OpeningConditions {
  std::string surface;   ///< name of the facet group
  bool listed = false;   ///< the case has [[opening]], and this is not the one of [inlet]
  bool demanded = true;  ///< whether the mesh must have the surface
};

/// Whether a case says that its fluid has no opening.
inline bool is_closed(const Case& setup) {
  return setup.fluid && setup.fluid->closed && !setup.inlet && setup.openings.empty();
}

/// The open boundaries of a case with fluid, in the order in which scenes and loads hold them: `inlet` with [inlet],
/// those of [[opening]] by name, and with fluid.outlet `outlet` if none of them is it. With [[opening]], or in a fluid
/// that the case says is closed, the mesh need not have the latter.
inline std::vector<OpeningData> openings_of(const Case& setup) {
  if (!setup.fluid) return {};
  std::vector<OpeningData> openings;
  if (setup.inlet || (setup.openings.empty() && !is_closed(setup))) openings.push_back({{setup.inlet}, group::inlet});
  for (const auto& [surface, conditions] : setup.openings) openings.push_back({conditions, surface, true});
  if (setup.fluid->outlet && setup.openings.count(group::outlet) == 0)
    openings.push_back({{}, group::outlet, !setup.openings.empty(), setup.openings.empty() && !is_closed(setup)});
  return openings;
}

/// The tables over time of inlet, load and openings, with their keys. Steps end at their jumps.
inline std::vector<std::pair<std::string, const PressureTable*>> tables_over_time(const Case& setup) {
  std::vector<std::pair<std::string, const PressureTable*>> tables;
  if (setup.inlet) tables.emplace_back("inlet.pressure", &*setup.inlet);
  if (setup.load) tables.emplace_back("load.pressure", &*setup.load);
  for (const auto& [surface, conditions] : setup.openings) {
    if (conditions.pressure) tables.emplace_back("opening." + surface + ".pressure", &*conditions.pressure);
    if (conditions.flow_rate) tables.emplace_back("opening." + surface + ".flow_rate", &conditions.flow_rate->table);
  }
  return tables;
}

}  // namespace fsi
