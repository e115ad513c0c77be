#pragma once

#include <optional>

#include "case/choices.hpp"
#include "case/pressure_table.hpp"
#include "openings/opening_laws.hpp"

namespace fsi {

/// A flow rate that prescribes the velocity at an opening (docs/theory.md, section 3.6).
struct FlowRateData {
  PressureTable table;  ///< (ms, mm^3/ms), positive into the fluid
  InflowProfile profile = InflowProfile::parabolic;
};

/// [[opening]]: the condition at a surface through which fluid may pass, at most one of pressure, flow_rate, law and
/// joined; with none it is free of traction (docs/theory.md, section 3.5).
struct OpeningConditions {
  std::optional<PressureTable> pressure{};  ///< on the fluid from outside, kPa
  std::optional<FlowRateData> flow_rate{};  ///< prescribes the velocity
  std::optional<OpeningLawData> law{};      ///< pressure as a function of the flow
  bool joined = false;                      ///< a node of [network], which then gives its pressure
  std::optional<double> backflow{};         ///< beta of its stabilisation; empty: BackflowTraction::standard

  bool is_free() const { return !pressure && !flow_rate && !law && !joined; }
};

}  // namespace fsi
