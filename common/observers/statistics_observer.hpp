#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

/// Takes the wall shear stress of each level into the averages over periods, which fields show; null where a case wants none.
template <int n>
std::unique_ptr<Observer> make_statistics_observer(const RunView<n>& watched);

}  // namespace fsi
