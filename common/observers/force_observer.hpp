#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

inline constexpr const char* surfaces_file = "surfaces.csv";

/// surfaces.csv, forces of the fluid on the surfaces that a case names, at the last balance of each step
/// (docs/theory.md, section 11a.4); null where it names none.
template <int n>
std::unique_ptr<Observer> make_force_observer(const RunView<n>& watched);

}  // namespace fsi
