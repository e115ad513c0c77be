#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

/// Whether fluid and wall keep together, for the summary: diagnostics/interface_watch.hpp. Null where they do not meet, or
/// nothing moves in time.
template <int n>
std::unique_ptr<Observer> make_interface_observer(const RunView<n>& watched);

}  // namespace fsi
