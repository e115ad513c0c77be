#pragma once

#include <string>
#include <vector>

#include "diagnostics/energy_record.hpp"

namespace fsi {

/// Header of energy.csv: the columns of the parts that a scene has.
std::string energy_header(const EnergyParts& parts);

/// The cells under it.
std::vector<double> energy_row(const EnergyParts& parts, int step, double time, const EnergyRecord& record);

}  // namespace fsi
