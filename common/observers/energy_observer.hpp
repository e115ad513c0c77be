#pragma once

#include <memory>

#include "diagnostics/energy_record.hpp"
#include "observers/run_view.hpp"

namespace fsi {

inline constexpr const char* energy_file = "energy.csv";

/// Columns of energy.csv behind the step and its time: those of the parts that a scene has.
Columns<EnergyRecord> energy_columns(const EnergyParts& parts);

/// The balance of energy of each step, docs/energy.md; null where the case wants none.
template <int n>
std::unique_ptr<Observer> make_energy_observer(const RunView<n>& watched);

}  // namespace fsi
