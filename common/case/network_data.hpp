#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "network/network.hpp"

namespace fsi {

inline constexpr const char* network_ground = "ground";  ///< the node that is the ground

/// [[network.element]]
struct NetworkElementData {
  std::string name;
  std::string kind;      ///< one of network_element_kinds()
  std::string from, to;  ///< nodes: openings, ground, or any other names
  ParameterValues values;
  std::optional<PressureTable> course{};  ///< over time, of kinds with a table
};

/// [network]
struct NetworkData {
  double ground_pressure = 0;  ///< kPa
  std::vector<NetworkElementData> elements;
};

/// The network of a case that has one. Its nodes are the joined openings in the order of openings_of(case), then the
/// others in the order in which elements name them.
std::shared_ptr<const Network> make_network(const Case& setup);

/// The periods of its elements with their keys, ms.
std::vector<std::pair<std::string, double>> periods_of_network(const Case& setup);

/// "2 openings, 3 other nodes, 5 elements in 2 loops, closed, 1200 mm^3 at the start". \param volume  its unit, "mm^3"
std::string text_of_network(const Network& network, const std::string& volume);

}  // namespace fsi
