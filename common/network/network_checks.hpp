#pragma once

#include <optional>
#include <string>

#include "network/network.hpp"

namespace fsi {

/// What is wrong with a network.
struct NetworkFault {
  std::string element;  ///< at fault; empty: the network as a whole
  std::string key;      ///< of the element in the case file
  std::string problem, remedy;
};

/// What keeps a network from having one solution whatever flows through its openings, or has no effect in it, if any.
/// \param step  ms, that steps may have
std::optional<NetworkFault> fault_of(const Network& network, double step);

}  // namespace fsi
