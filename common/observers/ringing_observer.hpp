#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

/// Warns once of a pressure that alternates from step to step (diagnostics/ringing_monitor.hpp), and keeps the largest
/// amplitude in the summary. Null in statics and where there is no centre line.
template <int n>
std::unique_ptr<Observer> make_ringing_observer(const RunView<n>& watched);

}  // namespace fsi
