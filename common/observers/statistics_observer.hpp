#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

/// Adds the wall shear stress of each level to averages over periods (fields tawss, osi, rrt); null without these.
template <int n>
std::unique_ptr<Observer> make_statistics_observer(const RunView<n>& watched);

}  // namespace fsi
