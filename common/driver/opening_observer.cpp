#include "driver/opening_observer.hpp"

#include "driver/same_rows.hpp"
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
  require_same_rows(earlier, openings_table(names_).file, level.time, opening_columns(), look(level));
}

#define FSI_INSTANTIATE(n) template class OpeningObserver<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
