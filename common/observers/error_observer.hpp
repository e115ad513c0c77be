#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

/// Adds the error indicator of each level to its mean over the run, a field of fields.h5; null where a case has none.
template <int n>
std::unique_ptr<Observer> make_error_observer(const RunView<n>& watched);

}  // namespace fsi
