#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

inline constexpr const char* openings_file = "openings.csv";

/// What openings.csv shows of a level, in cases with [[opening]]; null in others.
template <int n>
std::unique_ptr<Observer> make_opening_observer(const RunView<n>& watched);

}  // namespace fsi
