#pragma once

#include <fmt/format.h>

#include <functional>
#include <vector>

#include "materials/parameter.hpp"
#include "network/network_element.hpp"
#include "network/network_quantities.hpp"

namespace fsi {

/// dV/dt = q, dp = E(t) (V - V_0); y = V ([Suga1973]). Subclasses give E.
class TimeVaryingElastance : public NetworkElement {
 public:
  double initial_volume = 0;     ///< V at the start, mm^3
  double unstressed_volume = 0;  ///< V_0, mm^3

  /// E, kPa/mm^3. \param time  ms
  virtual double elastance(double time) const = 0;

  Equation equation(const NetworkMoment& at, double reference, double drop, double flow) const override {
    const double e = elastance(at.time);
    return {drop - e * (reference + at.lag * flow - unstressed_volume), 1, -e * at.lag};
  }
  Keeps keeps() const override { return Keeps::volume; }
  double start() const override { return initial_volume; }
  double kept(const NetworkMoment& at, double reference, double, double flow) const override {
    return reference + at.lag * flow;
  }
  double rate(double, double flow) const override { return flow; }

 protected:
  template <class Law>
  static std::vector<ParameterOf<Law>> volumes() {
    return {
        {&Law::initial_volume, "initial_volume", "at the start", quantity::volume(), not_negative},
        {&Law::unstressed_volume, "unstressed_volume", "without pressure", quantity::volume(), not_negative, false}};
  }
};

/// E(t) by a table.
class Elastance : public TimeVaryingElastance {
 public:
  std::function<double(double)> course;  ///< kPa/mm^3 at a time in ms

  static constexpr const char* name = "elastance";
  static std::vector<ParameterOf<Elastance>> parameters() { return volumes<Elastance>(); }

  double elastance(double time) const override { return course(time); }
  std::string description(const std::string& volume) const override {
    return fmt::format("elastance by a table, from {:g} {}", initial_volume, volume);
  }
};

}  // namespace fsi
