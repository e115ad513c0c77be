#pragma once

#include <nlohmann/json_fwd.hpp>

#include "system/work_unit.hpp"

namespace fsi {

/// What summary.json says of where a run was made, which a comparison of seconds needs.
/// {"processor"}, the model of those of the first process
nlohmann::json machine_json();
/// {"instruction_set", "doubles_per_pack", "compiler"}
nlohmann::json build_json();

/// {"seconds", "products", "entries", "measuring_s"}; null where nothing was measured.
nlohmann::json work_unit_json(const WorkUnit& unit);

/// \param seconds  of `steps` steps. \returns null where there is no unit or no step
nlohmann::json work_units_per_step(const WorkUnit& unit, double seconds, std::int64_t steps);

}  // namespace fsi
