#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "network/element_kinds.hpp"
#include "network/network.hpp"

namespace fsi::test {

/// An element as a case file states it.
struct Lumped {
  std::string kind, from, to;
  ParameterValues values;
  std::function<double(double)> course = nullptr;
};

/// Elements named "0 resistor", "1 valve" and so on. \param openings  names of nodes
inline Network network_of(std::vector<std::string> openings, const std::vector<Lumped>& lumped,
                          double ground_pressure = 0) {
  std::vector<std::string> nodes = openings;
  const auto number = [&](const std::string& name) {
    if (name == "ground") return Network::ground;
    const auto found = std::find(nodes.begin(), nodes.end(), name);
    if (found == nodes.end()) {
      nodes.push_back(name);
      return static_cast<int>(nodes.size()) - 1;
    }
    return static_cast<int>(found - nodes.begin());
  };
  std::vector<Network::Element> elements;
  for (const Lumped& element : lumped) {
    const int from = number(element.from), to = number(element.to);
    elements.push_back({std::to_string(elements.size()) + " " + element.kind,
                        network_element_kinds().at(element.kind).make(element.values, element.course), from, to});
  }
  return {std::move(nodes), openings.size(), std::move(elements), ground_pressure};
}

/// A ventricle that fills from a vein and empties into an opening, and what lies between that and the vein. Closed.
inline std::vector<Lumped> heart_between(const std::string& inlet, const std::string& outlet) {
  return {{"chamber",
           "ventricle",
           "ground",
           {{"minimum", 5e-4},
            {"maximum", 1e-2},
            {"period", 300},
            {"peak", 100},
            {"relaxed", 150},
            {"initial_volume", 2500}}},
          {"valve", "ventricle", inlet, {{"resistance", 0.02}, {"quadratic", 1e-4}}},
          {"resistor", outlet, "arteries", {{"resistance", 0.1}}},
          {"capacitor", "arteries", "ground", {{"compliance", 100}, {"initial_pressure", 10}}},
          {"resistor", "arteries", "veins", {{"resistance", 2}}},
          {"capacitor", "veins", "ground", {{"compliance", 3000}, {"initial_pressure", 1}}},
          {"diode", "veins", "ventricle", {{"resistance", 0.01}}}};
}

}  // namespace fsi::test
