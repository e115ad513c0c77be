#include "run/cost_summary.hpp"

#include <nlohmann/json.hpp>

#include "host/machine.hpp"
#include "math/pack.hpp"

namespace fsi {

nlohmann::json machine_json() {
  return {{"processor", processor()}};
}

nlohmann::json build_json() {
  return {{"instruction_set", instruction_set()}, {"doubles_per_pack", pack_width}, {"compiler", compiler()}};
}

nlohmann::json work_unit_json(const WorkUnit& unit) {
  if (unit.products == 0) return nullptr;
  return {
      {"seconds", unit.seconds}, {"products", unit.products}, {"entries", unit.entries}, {"measuring_s", unit.spent}};
}

nlohmann::json work_units_per_step(const WorkUnit& unit, double seconds, std::int64_t steps) {
  if (unit.products == 0 || !(unit.seconds > 0) || steps <= 0) return nullptr;
  return seconds / static_cast<double>(steps) / unit.seconds;
}

}  // namespace fsi
