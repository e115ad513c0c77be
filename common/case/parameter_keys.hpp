#pragma once

#include <functional>
#include <string>

#include "case/key_values.hpp"
#include "materials/parameter.hpp"

namespace fsi {

/// A parameter for help and messages: "meaning in unit, default 0".
std::string about(const Parameter& parameter);

/// Reads a parameter into the values that `place` finds.
template <class Row, class Target>
std::function<void(const CaseEntry&, Target&)> parameter_reader(const Row& p, Place<Target, ParameterValues> place) {
  return [p, place](const CaseEntry& entry, Target& target) {
    const double given = entry.number();
    if (!p.bounds.contains(given)) entry.refuse_value(p.bounds.problem(), p.bounds.remedy());
    entry.warn_of_unit(*p.quantity, given);
    place(target)[p.name] = given;
  };
}

/// The key of a law's parameter. \param place  where the Target has the law's values
template <class Target>
CaseKey<Target> parameter_key(const Parameter& p, Place<Target, ParameterValues> place) {
  KeyValue<Target> value;
  value.read = parameter_reader(p, place);
  value.write = [p, place](const Target& target) {
    const ParameterValues& values = place(target);
    const auto found = values.find(p.name);
    if (p.of_a_set && found == values.end()) return std::string("not given");
    return fmt::format("{}", found == values.end() ? p.standard : found->second);
  };
  return leaf(p.name, p.required, about(p), value);
}

}  // namespace fsi
