#pragma once

#include <memory>

#include "diagnostics/energy_record.hpp"
#include "observers/run_view.hpp"

namespace fsi {

inline constexpr const char* energy_file = "energy.csv";

/// Columns of energy.csv after the step and its time: those that apply to a scene with these parts.
Columns<EnergyRecord> energy_columns(const EnergyParts& parts);

/// energy.csv, the balance of energy of each step (docs/energy.md); null where the case switches it off.
template <int n>
std::unique_ptr<Observer> make_energy_observer(const RunView<n>& watched);

}  // namespace fsi
