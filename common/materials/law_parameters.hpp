#pragma once

#include <vector>

#include "materials/parameter.hpp"

namespace fsi {

/// A law with these values of its parameters, the others at their defaults. Names of other parameters are ignored.
template <class Law>
Law with_parameters(const ParameterValues& values) {
  Law law;
  for (const auto& parameter : Law::parameters()) {
    const auto value = values.find(parameter.name);
    if (value != values.end()) law.*parameter.member = value->second;
  }
  return law;
}

/// A law's parameters as users see them.
template <class Law>
std::vector<Parameter> parameters_of_law() {
  std::vector<Parameter> parameters;
  for (const auto& p : Law::parameters())
    parameters.push_back({p.name, p.about, &p.quantity, p.bounds, p.required, Law().*p.member});
  return parameters;
}

}  // namespace fsi
