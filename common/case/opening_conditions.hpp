#pragma once

#include <optional>

#include "case/choices.hpp"
#include "case/pressure_table.hpp"
#include "fluid/outflow_law.hpp"

namespace fsi {

/// The velocity at an opening by its flow.
struct FlowRateData {
  PressureTable table;  ///< (ms, mm^3/ms), positive into the fluid
  InflowProfile profile = InflowProfile::parabolic;
};

/// [[opening]]: what happens at a surface through which fluid may pass; with nothing of it, it is free of traction.
struct OpeningConditions {
  std::optional<PressureTable> pressure{};  ///< on the fluid from outside, kPa
  std::optional<FlowRateData> flow_rate{};  ///< prescribes the velocity
  std::optional<OutflowLaw> outflow_law{};  ///< a resistance or a Windkessel
  std::optional<double> backflow{};         ///< beta of its stabilisation (fluid/backflow.hpp); empty: the standard
};

}  // namespace fsi
