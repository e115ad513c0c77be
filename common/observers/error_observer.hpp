#pragma once

#include <memory>

#include "observers/watched.hpp"

namespace fsi {

/// Takes the error indicator of each level into its mean over the run, which fields show; null where a case wants none.
template <int n>
std::unique_ptr<Observer> make_error_observer(const Watched<n>& watched);

}  // namespace fsi
