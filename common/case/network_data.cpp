#include "case/network_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "case/openings.hpp"
#include "network/element_kinds.hpp"

namespace fsi {

std::shared_ptr<const Network> make_network(const Case& setup) {
  const NetworkData& data = *setup.network;
  std::vector<std::string> nodes;
  for (const OpeningData& opening : openings_of(setup))
    if (opening.joined) nodes.push_back(opening.surface);
  const std::size_t openings = nodes.size();
  const auto number = [&](const std::string& name) {
    if (name == network_ground) return Network::ground;
    const auto found = std::find(nodes.begin(), nodes.end(), name);
    if (found != nodes.end()) return static_cast<int>(found - nodes.begin());
    nodes.push_back(name);
    return static_cast<int>(nodes.size()) - 1;
  };
  std::vector<Network::Element> elements;
  for (const NetworkElementData& element : data.elements) {
    std::function<double(double)> course;
    if (element.course) course = [table = *element.course](double time) { return table.at(time); };
    const int from = number(element.from), to = number(element.to);
    const NetworkElementKind& kind = network_element_kinds().at(element.kind);
    elements.push_back({element.name, kind.make(element.values, course), from, to});
  }
  return std::make_shared<const Network>(std::move(nodes), openings, std::move(elements), data.ground_pressure);
}

std::vector<std::pair<std::string, double>> periods_of_network(const Case& setup) {
  std::vector<std::pair<std::string, double>> periods;
  if (!setup.network) return periods;
  for (const NetworkElementData& element : setup.network->elements) {
    const auto law = network_element_kinds().at(element.kind).make(element.values, nullptr);
    const double period = element.course ? element.course->period : law->period();
    if (period > 0) periods.emplace_back("network.element." + element.name, period);
  }
  return periods;
}

std::string text_of_network(const Network& network, const std::string& volume) {
  const auto count = [](std::size_t number, const char* one, const char* more) {
    return fmt::format("{} {}", number, number == 1 ? one : more);
  };
  const std::size_t openings = network.openings(), loops = static_cast<std::size_t>(network.loops());
  const std::vector<double> start = network.start();
  return fmt::format("{}, {}, {} in {}, {}, {:.6g} {} at the start", count(openings, "opening", "openings"),
                     count(network.nodes().size() - openings, "other node", "other nodes"),
                     count(network.elements().size(), "element", "elements"), count(loops, "loop", "loops"),
                     network.is_closed() ? "closed" : "not closed: fluid comes from or goes to the ground",
                     network.volume(start.data()), volume);
}

}  // namespace fsi
