#include "driver/opening_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/error.hpp"
#include "driver/same_state.hpp"
#include "fem/dimensions.hpp"

namespace fsi {

template <int n>
OpeningObserver<n>::OpeningObserver(const Case& setup, const Scene<n>& scene) {
  if (setup.openings.empty() || !scene.fluid) return;
  for (const auto& open : scene.fluid->open_boundaries()) {
    if (open.empty()) continue;
    openings_.push_back(&open);
    names_.push_back(open.name());
  }
}

template <int n>
std::vector<OpeningRecord> OpeningObserver<n>::look(const State& level) const {
  std::vector<OpeningRecord> records;
  for (const auto* open : openings_) {
    const OutflowLaw* law = open->law();
    const double behind = law == nullptr  ? 0
                          : law->stores() ? level.now.windkessel[open->place()]
                                          : law->distal_pressure;
    const auto &mesh = level.now.mesh, &flow = level.now.fluid;
    records.push_back({open->outflow(mesh, flow), open->mean_pressure(mesh, flow), behind});
  }
  return records;
}

template <int n>
void OpeningObserver<n>::write(const State& level, ResultFolder& folder) const {
  if (!openings_.empty()) folder.write_openings(level.time, look(level));
}

template <int n>
void OpeningObserver<n>::require_same(const State& level, const EarlierTables& earlier) const {
  if (openings_.empty()) return;
  constexpr std::size_t width = 4;  // time, flow, two pressures
  const std::string file = openings_table(names_).file;
  const auto& rows = earlier.last_level(file);
  if (rows.empty()) return;
  const auto seen = look(level);
  // Of the largest number of a unit: small ones may be rounding alone.
  for (const bool pressures : {false, true}) {
    double size = 0, apart = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const std::array<double, 2> values =
          pressures ? std::array<double, 2>{seen[i].mean_pressure, seen[i].windkessel_pressure}
                    : std::array<double, 2>{seen[i].flow, seen[i].flow};
      for (std::size_t k = 0; k < 2; ++k) {
        const double row = rows.at(i * width + (pressures ? 2 + k : 1));
        const double value = pressures ? pascal_per_kilopascal * values[k] : values[k];
        size = std::max({size, std::abs(row), std::abs(value)});
        apart = std::max(apart, std::abs(row - value));
      }
    }
    if (!(apart <= same_state * size))
      throw InputError((earlier.folder() / file).string(), "",
                       fmt::format("its rows of the time {:g} differ from the checkpoint's state by {:.1e} of their "
                                   "largest value: the two are not of one run",
                                   level.time, apart / size),
                       "restart from a folder as its run has left it, or run from the start");
  }
}

#define FSI_INSTANTIATE(n) template class OpeningObserver<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
