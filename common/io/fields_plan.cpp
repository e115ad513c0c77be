#include "io/fields_plan.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace fsi {

FieldPlan planned_field_steps(std::int64_t last_step, std::int64_t every, std::function<double(std::int64_t)> time_of,
                              const std::vector<std::int64_t>& besides) {
  if (every <= 0) return {};
  const std::int64_t regular = last_step / every + 1 + (last_step % every != 0 ? 1 : 0);
  std::vector<std::int64_t> more, places;  // steps that are not among the regular ones, and their entries
  for (const std::int64_t step : besides) {
    if (step % every == 0 || step >= last_step) continue;
    places.push_back(step / every + 1 + static_cast<std::int64_t>(more.size()));
    more.push_back(step);
  }
  const auto entries = regular + static_cast<std::int64_t>(more.size());
  return {entries, [=, time_of = std::move(time_of)](std::int64_t entry) {
            const auto next = std::lower_bound(places.begin(), places.end(), entry) - places.begin();
            const bool is_more = next < static_cast<std::ptrdiff_t>(places.size()) && places[next] == entry;
            const std::int64_t step = is_more ? more[next] : std::min((entry - next) * every, last_step);
            return FieldStep{step, time_of(step)};
          }};
}

}  // namespace fsi
