#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

/// Writes the fields of the levels that the case asks for. A restart refuses fields.h5 if entries are missing.
template <int n>
std::unique_ptr<Observer> make_field_observer(const RunView<n>& watched);

}  // namespace fsi
