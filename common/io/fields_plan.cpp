#include "io/fields_plan.hpp"

#include <algorithm>
#include <utility>

namespace fsi {

FieldPlan planned_field_steps(std::int64_t last_step, std::int64_t every, std::function<double(std::int64_t)> time_of) {
  if (every <= 0) return {};
  const std::int64_t entries = last_step / every + 1 + (last_step % every != 0 ? 1 : 0);
  return {entries, [last_step, every, time_of = std::move(time_of)](std::int64_t entry) {
            const std::int64_t step = std::min(entry * every, last_step);
            return FieldStep{step, time_of(step)};
          }};
}

}  // namespace fsi
