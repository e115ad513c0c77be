#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

inline constexpr const char* coupling_file = "coupling.csv";

/// What steps took: iterations.csv, and coupling.csv of steppers that report how fluid and wall came to agree.
template <int n>
std::unique_ptr<Observer> make_step_observer(const RunView<n>& watched);

}  // namespace fsi
