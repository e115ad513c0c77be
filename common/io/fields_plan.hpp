#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace fsi {

/// An entry of fields.h5.
struct FieldStep {
  std::int64_t step = 0;  ///< its number: that of the step if entries are counted in steps, else of the entry
  double time = 0;        ///< ms
};

/// The entries that a run is to write, as a function, so that a plan costs nothing however long it is.
struct FieldPlan {
  std::int64_t entries = 0;
  std::function<FieldStep(std::int64_t)> at;  ///< for 0, ..., entries - 1; ascending in step and time
};

/// Steps 0, every, 2 every, ... and the last one; nothing when every is 0.
/// \param time_of  end of a step, ms; called as long as the plan is used
/// \param besides  further steps, ascending
FieldPlan planned_field_steps(std::int64_t last_step, std::int64_t every, std::function<double(std::int64_t)> time_of,
                              const std::vector<std::int64_t>& besides = {});

/// The first of the numbers 0, ..., count - 1 for which `holds`, by bisection; count if none. It must hold for all
/// after.
template <class Condition>
std::int64_t first_that(std::int64_t count, Condition holds) {
  std::int64_t from = 0;
  while (from < count) {
    const std::int64_t middle = from + (count - from) / 2;
    if (holds(middle))
      count = middle;
    else
      from = middle + 1;
  }
  return from;
}

}  // namespace fsi
