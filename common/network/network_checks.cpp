#include "network/network_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fsi {

namespace {

using Fault = std::optional<NetworkFault>;
constexpr double flow_of_rounding = 1e-9;  // scaled

/// Elements with an end at a node.
std::vector<const Network::Element*> elements_at(const Network& network, int node) {
  std::vector<const Network::Element*> all;
  for (const auto& element : network.elements())
    if (element.from == node || element.to == node) all.push_back(&element);
  return all;
}

std::string names_of(const std::vector<const Network::Element*>& elements) {
  std::vector<std::string> names;
  for (const auto* element : elements) names.push_back(element->name);
  return fmt::format("{}", fmt::join(names, ", "));
}

Fault parameters(const Network& network) {
  for (const auto& element : network.elements())
    if (const auto contradiction = element.law->contradiction())
      return NetworkFault{element.name, contradiction->parameter, contradiction->problem, contradiction->remedy};
  return std::nullopt;
}

/// Ends without effect.
Fault ends(const Network& network) {
  std::vector<std::string> known = network.nodes();
  known.emplace_back("ground");
  for (const auto& element : network.elements())
    if (element.from == element.to)
      return NetworkFault{element.name, "between", "has both ends at one node, where it has no effect",
                          "join it to another node"};
  for (const auto& element : network.elements())
    if (element.from == Network::ground && element.law->keeps() == NetworkElement::Keeps::volume)
      return NetworkFault{element.name, "between", "begins at the ground, and what it stores is where it begins",
                          "give \"ground\" as the second node"};
  for (std::size_t i = network.openings(); i < network.nodes().size(); ++i)
    if (const auto at = elements_at(network, static_cast<int>(i)); at.size() == 1) {
      known.erase(std::remove(known.begin(), known.end(), network.nodes()[i]), known.end());
      return NetworkFault{
          at.front()->name, "between",
          fmt::format("nothing else is joined to the node \"{}\", which is no [[opening]]: no fluid can pass it",
                      network.nodes()[i]),
          fmt::format("join it to one of {}, or give \"{}\" an [[opening]]", fmt::join(known, ", "),
                      network.nodes()[i])};
    }
  return std::nullopt;
}

/// Nodes that a chain of elements joins to one of `from`; chains lead through the ground only if `through_ground`.
std::vector<bool> joined_to(const Network& network, const std::vector<int>& from, bool through_ground) {
  std::vector<bool> reached(network.nodes().size() + 1, false);  // the ground is the last
  const auto place = [&](int node) {
    return node == Network::ground ? network.nodes().size() : static_cast<std::size_t>(node);
  };
  for (const int node : from) reached[place(node)] = true;
  for (bool more = true; more;) {
    more = false;
    for (const auto& element : network.elements()) {
      const bool a = reached[place(element.from)], b = reached[place(element.to)];
      if (a == b) continue;
      const int known = a ? element.from : element.to;
      if (known == Network::ground && !through_ground) continue;
      reached[place(element.from)] = reached[place(element.to)] = true;
      more = true;
    }
  }
  return reached;
}

/// Parts that the vessel does not feel, and parts whose pressure has no level.
Fault parts(const Network& network) {
  std::vector<int> openings;
  for (std::size_t i = 0; i < network.openings(); ++i) openings.push_back(static_cast<int>(i));
  const auto by_vessel = joined_to(network, openings, false);
  const auto by_ground = joined_to(network, {Network::ground}, true);
  for (const auto& element : network.elements()) {
    const int node = element.from == Network::ground ? element.to : element.from;
    if (!by_vessel[static_cast<std::size_t>(node)])
      return NetworkFault{element.name, "between",
                          fmt::format("no element leads from the node \"{}\" to an [[opening]]: it has no effect",
                                      network.nodes()[static_cast<std::size_t>(node)]),
                          "join that part of the network to an opening, or remove it"};
    if (!by_ground[static_cast<std::size_t>(node)])
      return NetworkFault{element.name, "between",
                          fmt::format("no element leads from the node \"{}\" to the ground: the level of the pressure "
                                      "is not determined there",
                                      network.nodes()[static_cast<std::size_t>(node)]),
                          "join a capacitor or an elastance between that part of the network and \"ground\""};
  }
  return std::nullopt;
}

NetworkFault of_open_column(const Network& network, std::size_t column) {
  const std::size_t nodes = network.nodes().size();
  if (column >= nodes)
    return {
        network.elements()[column - nodes].name, "between",
        "closes a loop of elements that each give a difference of pressure (sources, capacitors, elastances): it is "
        "over-determined",
        "put a resistor into the loop, or replace these elements by one"};
  const auto at = elements_at(network, static_cast<int>(column));
  return {at.empty() ? "" : at.front()->name, "between",
          fmt::format("the flows into the node \"{}\" are all given, by {}: it is over-determined, and its pressure is "
                      "not determined",
                      network.nodes()[column], names_of(at)),
          "join a capacitor or a resistor to that node"};
}

Fault determined(const Network& network, double step) {
  const std::vector<double> y = network.start();
  NetworkState rest;
  rest.pressures.assign(network.nodes().size(), 0.0);
  rest.flows.assign(network.elements().size(), 0.0);
  const auto open_columns = [&](double lag) { return network.jacobian({lag, 0}, y.data(), rest).open_columns(); };
  if (const auto open = open_columns(step); !open.empty()) return of_open_column(network, open.front());
  for (const std::size_t column : open_columns(0))
    if (column >= network.openings()) return of_open_column(network, column);
  return std::nullopt;
}

Fault start(const Network& network) {
  if (std::abs(network.contradiction_at_start()) <= flow_of_rounding) return std::nullopt;
  for (const auto& element : network.elements())
    if (element.law->keeps() == NetworkElement::Keeps::flow && element.law->start() != 0)
      return NetworkFault{element.name, "initial_flow",
                          "belongs to no flow of the fluid, which is at rest at the start",
                          "give flows that add up to 0 at openings"};
  return NetworkFault{"", "", "what it begins with contradicts itself", "give other initial values"};
}

}  // namespace

std::optional<NetworkFault> fault_of(const Network& network, double step) {
  if (auto fault = parameters(network)) return fault;
  if (auto fault = ends(network)) return fault;
  if (auto fault = parts(network)) return fault;
  if (auto fault = determined(network, step)) return fault;
  return start(network);
}

}  // namespace fsi
