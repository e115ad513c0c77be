#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

inline constexpr const char* coupling_file = "coupling.csv";

/// iterations.csv, the cost of each step, and coupling.csv of steppers that report the coupling of fluid and wall.
template <int n>
std::unique_ptr<Observer> make_step_observer(const RunView<n>& watched);

}  // namespace fsi
