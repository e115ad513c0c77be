#pragma once

#include "diagnostics/energy_record.hpp"
#include "io/column.hpp"

namespace fsi {

/// Columns of energy.csv behind the step and its time: those of the parts that a scene has.
Columns<EnergyRecord> energy_columns(const EnergyParts& parts);

}  // namespace fsi
