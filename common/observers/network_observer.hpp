#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

inline constexpr const char* network_file = "network.csv";

/// network.csv, in cases with [network]; null in others.
template <int n>
std::unique_ptr<Observer> make_network_observer(const RunView<n>& watched);

}  // namespace fsi
