#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

inline constexpr const char* openings_file = "openings.csv";

/// openings.csv, in cases with [[opening]]; null where a case, or its mesh, has none.
template <int n>
std::unique_ptr<Observer> make_opening_observer(const RunView<n>& watched);

}  // namespace fsi
