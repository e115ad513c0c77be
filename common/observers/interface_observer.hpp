#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

/// How far fluid and wall come apart at the interface (diagnostics/interface_watch.hpp), for the summary, and a warning
/// above 1 %. Null in scenes without interface and in statics.
template <int n>
std::unique_ptr<Observer> make_interface_observer(const RunView<n>& watched);

}  // namespace fsi
