#include "observers/periodicity_observer.hpp"

#include <fmt/format.h>

#include <vector>

#include "derived/period_change.hpp"
#include "fem/dimensions.hpp"

namespace fsi {

namespace {

nlohmann::json summary_of(const PeriodChange& change) {
  return {{"end_ms", change.end},
          {"pressure", change.pressure},
          {"flow", change.flow},
          {"displacement", change.displacement}};
}

template <int n>
class PeriodicityObserver : public Observer {
 public:
  PeriodicityObserver(const Watched<n>& watched, std::vector<std::size_t> openings)
      : scene_(watched.scene),
        voice_(watched.voice),
        openings_(std::move(openings)),
        period_(*watched.setup.time->period),
        largest_change_(*watched.setup.time->periodic_change),
        comparison_(period_, openings_.size(), n) {}

  void begin(const State&) override { note(); }

  void look(const State& level) override {
    auto extremes = comparison_.add(level.time, values_at(level));
    if (!extremes) return;
    for (auto* part : {&extremes->difference, &extremes->range, &extremes->size})
      for (double& value : *part) value = scene_.processes().largest(value);
    changes_.push_back(change_of(*extremes, comparison_.last_end()));
    const PeriodChange& last = changes_.back();
    voice_.say(fmt::format(
        "period {:.0f}, to {:g} ms, differs from the one before by {:.3g} % in pressure, {:.3g} % in flow, {:.3g} % in "
        "displacement, of their ranges{}",
        last.end / period_, last.end, 100 * last.pressure, 100 * last.flow, 100 * last.displacement,
        wants_end() ? fmt::format(": periodic within {:g} %, the run ends", 100 * largest_change_) : ""));
    note();
  }

  bool wants_end() const override { return !changes_.empty() && changes_.back().largest() <= largest_change_; }

  void end() override {
    if (wants_end()) return;
    voice_.warn(fmt::format(
        "the run is not periodic within {:g} %: {}; continue it with a later time.end", 100 * largest_change_,
        changes_.empty() ? std::string("no two periods were compared")
                         : fmt::format("its last whole period differs from the one before by {:.3g} %",
                                       100 * changes_.back().largest())));
  }

  void keep(Memory& memory) override {
    if (!memory.recalls()) comparison_.share(scene_.processes());
    comparison_.keep(memory);
    if (!memory.wants({"changes"})) return;
    std::vector<double> numbers;
    for (const PeriodChange& c : changes_) numbers.insert(numbers.end(), {c.end, c.pressure, c.flow, c.displacement});
    memory.array("changes", ArrayKind::alike, numbers);
    changes_.clear();
    for (std::size_t i = 0; i + 3 < numbers.size(); i += 4)
      changes_.push_back({numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]});
  }

 private:
  PeriodicValues values_at(const State& level) const {
    PeriodicValues values;
    for (const std::size_t i : openings_) {
      const auto& open = scene_.fluid->open_boundaries()[i];
      values.pressures.push_back(open.mean_pressure(level.now.mesh, level.now.fluid));
      values.flows.push_back(open.outflow(level.now.mesh, level.now.fluid));
    }
    for (const InterfaceNode& node : scene_.interface)
      for (int k = 0; k < n; ++k) values.displacement.push_back(level.now.wall[MixedLayout<n>::vector(node.wall, k)]);
    return values;
  }

  /// An entry of the summary, with all periods compared so far.
  void note() const {
    auto compared = nlohmann::json::array();
    for (const PeriodChange& change : changes_) compared.push_back(summary_of(change));
    voice_.note("periodicity", {{"period_ms", period_},
                                {"asked", largest_change_},
                                {"reached", wants_end()},
                                {"changes", std::move(compared)}});
  }

  const Scene<n>& scene_;
  Voice& voice_;
  std::vector<std::size_t> openings_;  ///< numbers of those that the mesh has
  double period_, largest_change_;
  PeriodComparison comparison_;
  std::vector<PeriodChange> changes_;  ///< of the periods from the second one on
};

}  // namespace

template <int n>
std::unique_ptr<Observer> make_periodicity_observer(const Watched<n>& watched) {
  if (!watched.setup.time || !watched.setup.time->periodic_change) return nullptr;
  std::vector<std::size_t> openings;
  const auto& open = watched.scene.fluid->open_boundaries();
  for (std::size_t i = 0; i < open.size(); ++i)
    if (!open[i].empty()) openings.push_back(i);
  return std::make_unique<PeriodicityObserver<n>>(watched, std::move(openings));
}

#define FSI_INSTANTIATE(n) template std::unique_ptr<Observer> make_periodicity_observer(const Watched<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
