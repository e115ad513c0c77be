#pragma once

#include <optional>

#include "case/choices.hpp"
#include "case/pressure_table.hpp"
#include "openings/opening_laws.hpp"

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
  std::optional<OpeningLawData> law{};      ///< of a pressure that depends on the flow
  bool joined = false;                      ///< by [network], which then gives its pressure
  std::optional<double> backflow{};         ///< beta of its stabilisation (fluid/backflow.hpp); empty: the standard

  bool is_free() const { return !pressure && !flow_rate && !law && !joined; }
};

}  // namespace fsi
