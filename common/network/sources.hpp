#pragma once

#include <fmt/format.h>

#include <functional>
#include <vector>

#include "materials/parameter.hpp"
#include "network/network_element.hpp"

namespace fsi {

/// dp = P(t).
class PressureSource : public NetworkElement {
 public:
  std::function<double(double)> course;  ///< kPa at a time in ms

  static constexpr const char* name = "pressure";
  static std::vector<ParameterOf<PressureSource>> parameters() { return {}; }

  Equation equation(const NetworkMoment& at, double, double drop, double) const override {
    return {drop - course(at.time), 1, 0};
  }
  std::string description(const std::string&) const override { return "a given drop of the pressure"; }
};

/// q = Q(t).
class FlowSource : public NetworkElement {
 public:
  std::function<double(double)> course;  ///< mm^3/ms at a time in ms

  static constexpr const char* name = "flow";
  static std::vector<ParameterOf<FlowSource>> parameters() { return {}; }

  Equation equation(const NetworkMoment& at, double, double, double flow) const override {
    return {flow - course(at.time), 0, 1};
  }
  std::string description(const std::string&) const override { return "a given flow"; }
};

}  // namespace fsi
