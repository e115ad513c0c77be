#include "partitioned/schemes/splitting_error_monitor.hpp"

#include <fmt/format.h>

#include <cmath>

namespace fsi {

double SplittingErrorMonitor::gap() const {
  return movements_ > 0 ? std::sqrt(gaps_ / movements_) : 0.0;
}

std::string SplittingErrorMonitor::unchecked() const {
  if (!(gap() > small)) return {};
  return fmt::format(
      "the {} coupling does not iterate, and its error is not small: the velocities of fluid and wall on the interface "
      "differ by {:.2g} of the wall's (root mean square over all steps, more than {:g}); take a smaller time.step, or "
      "compare with partitioned.scheme = \"block-newton\"",
      scheme_->name, gap(), small);
}

void SplittingErrorMonitor::keep(RestartArchive& archive) {
  const Range sum{0};
  archive.number_if_there("loose_gaps", gaps_, sum);
  archive.number_if_there("loose_movements", movements_, sum);
}

}  // namespace fsi
