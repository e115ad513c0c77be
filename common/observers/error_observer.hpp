#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

/// Takes the error indicator of each level into its mean over the run, which fields show; null where a case wants none.
template <int n>
std::unique_ptr<Observer> make_error_observer(const RunView<n>& watched);

}  // namespace fsi
