#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

/// Names a pressure that alternates from step to step, once, and keeps the largest of it in the summary. Null in statics and
/// where there is no centre line.
template <int n>
std::unique_ptr<Observer> make_ringing_observer(const RunView<n>& watched);

}  // namespace fsi
