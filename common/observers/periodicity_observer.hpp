#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

/// Says after each period how pressures, flows and displacements changed from the one before, and ends a run that wants to
/// become periodic; null where a case wants none.
template <int n>
std::unique_ptr<Observer> make_periodicity_observer(const RunView<n>& watched);

}  // namespace fsi
