#include "observers/opening_observer.hpp"

#include "fem/dimensions.hpp"

namespace fsi {

namespace {

/// Numbers of openings.csv for one opening at a level.
struct OpeningRecord {
  double flow = 0;      ///< mm^3/ms, out of the fluid
  double pressure = 0;  ///< of the fluid, mean over the surface, kPa; written in Pa
  double behind = 0;    ///< stored by a Windkessel; behind a resistance the distal pressure, else 0; kPa; written in Pa
};

const Columns<OpeningRecord>& opening_columns() {
  using R = OpeningRecord;
  static const Columns<R> columns{
      {"flow_mm3_per_ms", [](const R& r) { return r.flow; }, Measure::flow},
      {"mean_pressure_Pa", [](const R& r) { return pascal_per_kilopascal * r.pressure; }, Measure::pressure},
      {"windkessel_pressure_Pa", [](const R& r) { return pascal_per_kilopascal * r.behind; }, Measure::pressure}};
  return columns;
}

template <int n>
class OpeningObserver : public Observer {
 public:
  OpeningObserver(const Scene<n>& scene, std::vector<std::size_t> openings)
      : scene_(scene), openings_(std::move(openings)) {}

  std::vector<ResultTable> tables() const override {
    std::vector<std::string> names;
    for (const std::size_t i : openings_) names.push_back(scene_.fluid->open_boundaries()[i].name());
    return {table_of(openings_file, opening_columns(), RowsPer::level, "opening", std::move(names))};
  }
  std::vector<TableRows> rows_at(const State& level) const override {
    std::vector<OpeningRecord> records;
    for (const std::size_t i : openings_) {
      const auto& open = scene_.fluid->open_boundaries()[i];
      const auto* answering = scene_.openings.answering(i);
      const double behind =
          answering ? answering->law->pressure_behind(level.now.openings.data() + answering->place) : 0;
      const auto &mesh = level.now.mesh, &flow = level.now.fluid;
      records.push_back({open.outflow(mesh, flow), open.mean_pressure(mesh, flow), behind});
    }
    return {rows_of(openings_file, {level.time}, opening_columns(), records)};
  }

 private:
  const Scene<n>& scene_;
  std::vector<std::size_t> openings_;  ///< numbers of those that the mesh has
};

}  // namespace

template <int n>
std::unique_ptr<Observer> make_opening_observer(const RunView<n>& watched) {
  std::vector<std::size_t> openings;
  if (!watched.setup.openings.empty() && watched.scene.fluid) {
    const auto& open = watched.scene.fluid->open_boundaries();
    for (std::size_t i = 0; i < open.size(); ++i)
      if (!open[i].empty()) openings.push_back(i);
  }
  if (openings.empty()) return nullptr;
  return std::make_unique<OpeningObserver<n>>(watched.scene, std::move(openings));
}

#define FSI_INSTANTIATE(n) template std::unique_ptr<Observer> make_opening_observer(const RunView<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
