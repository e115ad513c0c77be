#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

/// Reports after each period how pressures, flows and displacements changed from the one before, and ends the run once
/// it is periodic, or as periodic as its steps allow (time.periods); null in other cases.
template <int n>
std::unique_ptr<Observer> make_periodicity_observer(const RunView<n>& watched);

}  // namespace fsi
