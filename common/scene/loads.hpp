#pragma once

#include "case/openings.hpp"
#include "case/support_loads.hpp"
#include "scene/time_axis.hpp"
#include "time/state.hpp"
#include "time/time_integrator.hpp"

namespace fsi {

/// The loads of a case, step by step: pressures, tractions, and flows at openings. A load in time is taken as means of
/// its table over the shares of a step that the time scheme names, so that the impulse does not depend on the time
/// step. Flows are those at the end of a stage. A static load rises with the load's fraction to the table's last value.
class Loads {
 public:
  /// \param setup  must outlive this
  explicit Loads(const Case& setup)
      : setup_(setup), openings_(openings_of(setup)), supports_(support_loads_of(setup)), axis_(setup) {}

  /// When the steps are.
  const TimeAxis& axis() const { return axis_; }
  TimeAxis& axis() { return axis_; }
  int steps() const { return axis_.steps(); }
  double time_of(int step) const { return axis_.time_of(step); }

  /// Length of a step, ms; 0 in statics.
  double step_length(int step) const { return axis_.length_of(step); }

  /// kPa, of a step: at the open boundaries, in the order of openings_of(case).
  std::vector<double> opening_pressures(int step) const {
    std::vector<double> pressures;
    for (const OpeningData& opening : openings_)
      pressures.push_back(opening.pressure ? opening.pressure->mean(time_of(step - 1), time_of(step)) : 0.0);
    return pressures;
  }
  /// kPa, of a step: on the inner face of a wall without fluid.
  double wall_pressure(int step) const {
    if (!setup_.load) return 0.0;
    if (setup_.time) return setup_.load->mean(time_of(step - 1), time_of(step));
    const double first = setup_.prestress ? setup_.prestress->pressure : 0.0;
    return first + time_of(step) * (setup_.load->at_end() - first);
  }
  /// kPa, of a load step: the loads of the wall's supports, in the order of support_loads_of(case). A wall under prestress
  /// carries them from the start.
  std::vector<double> static_support_loads(int step) const {
    std::vector<double> loads;
    for (const SupportLoad& load : supports_)
      loads.push_back((setup_.prestress ? 1.0 : time_of(step)) * load.course.at_end());
    return loads;
  }

  /// Data of the step that follows the state's last one, or of one stage of it.
  StepData next(const State& state, const TimeIntegrator& integrator, int stage = 0) const {
    StepData data;
    const int step = state.step + 1;
    data.time = time_of(step);
    data.rates = integrator.rates(state, step_length(step), stage);
    if (data.rates.is_static()) {
      data.opening_pressures = opening_pressures(step);
      data.wall_pressure = wall_pressure(step);
      data.support_loads = static_support_loads(step);
      return data;
    }
    data.rates.end = data.rates.last_stage ? data.time : data.rates.end;
    data.ends_at_jump = axis_.jumps_at(data.time);
    for (std::size_t i = 0; i < openings_.size(); ++i)
      data.opening_pressures.push_back(openings_[i].pressure ? of_balance(*openings_[i].pressure, data, state, i)
                                                             : 0.0);
    set_flows(data);
    for (const SupportLoad& load : supports_)
      data.support_loads.push_back(of_balance(load.course, data, state, openings_.size() + data.support_loads.size()));
    if (setup_.load) data.wall_pressure = of_balance(*setup_.load, data, state, openings_.size() + supports_.size());
    return data;
  }

 private:
  void set_flows(StepData& data) const {
    for (std::size_t i = 0; i < openings_.size(); ++i) {
      if (!openings_[i].flow_rate) continue;
      data.opening_flows.resize(openings_.size(), 0.0);
      data.opening_flows[i] = openings_[i].flow_rate->table.at(data.rates.end);
    }
  }

  /// \param place  of the table in State::load_rates
  static double of_balance(const PressureTable& table, const StepData& data, const State& state, std::size_t place) {
    const StepRates& rates = data.rates;
    double load = 0;
    // Ends of shares that are the step's are taken as the axis has them, free of rounding.
    const auto exact = [&](double time) { return time == state.time + rates.step ? data.time : time; };
    for (const LoadShare& share : rates.load) load += share.weight * table.mean(share.from, exact(share.to));
    if (rates.load_rate_weight != 0) load += rates.load_rate_weight * state.load_rates.at(place);
    return load;
  }

  const Case& setup_;
  std::vector<OpeningData> openings_;
  std::vector<SupportLoad> supports_;
  TimeAxis axis_;
};

}  // namespace fsi
