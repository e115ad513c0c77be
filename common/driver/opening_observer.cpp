#include "driver/opening_observer.hpp"

#include "driver/same_rows.hpp"
#include "fem/dimensions.hpp"

namespace fsi {

template <int n>
OpeningObserver<n>::OpeningObserver(const Case& setup, const Scene<n>& scene) : scene_(scene) {
  if (setup.openings.empty() || !scene.fluid) return;
  const auto& open = scene.fluid->open_boundaries();
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (open[i].empty()) continue;
    openings_.push_back(i);
    names_.push_back(open[i].name());
  }
}

template <int n>
std::vector<OpeningRecord> OpeningObserver<n>::look(const State& level) const {
  std::vector<OpeningRecord> records;
  for (const std::size_t i : openings_) {
    const auto& open = scene_.fluid->open_boundaries()[i];
    const auto* answering = scene_.openings.answering(i);
    const double behind = answering ? answering->law->pressure_behind(level.now.openings.data() + answering->place) : 0;
    const auto &mesh = level.now.mesh, &flow = level.now.fluid;
    records.push_back({open.outflow(mesh, flow), open.mean_pressure(mesh, flow), behind});
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
