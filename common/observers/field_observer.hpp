#pragma once

#include <memory>

#include "observers/watched.hpp"

namespace fsi {

/// Writes the fields of the levels that the case asks for, and knows how many there are.
template <int n>
std::unique_ptr<Observer> make_field_observer(const Watched<n>& watched);

}  // namespace fsi
