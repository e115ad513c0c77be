#include "observers/periodicity_observer.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "case/scene_period.hpp"
#include "derived/period_change.hpp"
#include "derived/periodic_approach.hpp"
#include "fem/dimensions.hpp"

namespace fsi {

namespace {

constexpr std::size_t numbers_of_change = 10;  // in the restart archive, per PeriodChange

/// The opening whose law has the longest time constant.
struct SlowestLaw {
  std::string opening;       ///< empty: none has any
  double time_constant = 0;  ///< ms
};

SlowestLaw slowest_law(const Case& setup) {
  SlowestLaw slowest;
  for (const auto& [surface, conditions] : setup.openings) {
    if (!conditions.law) continue;
    const double time_constant = conditions.law->make()->time_constant();
    if (time_constant > slowest.time_constant) slowest = {surface, time_constant};
  }
  return slowest;
}

template <int n>
class PeriodicityObserver : public Observer {
 public:
  PeriodicityObserver(const RunView<n>& watched, std::vector<std::size_t> openings)
      : scene_(watched.scene),
        messages_(watched.messages),
        openings_(std::move(openings)),
        period_(*watched.setup.time->period),
        start_given_(watched.setup.time->start == StartOfOpenings::given),
        slowest_(slowest_law(watched.setup)),
        advice_(about_steps_of_periods(watched.setup)),
        comparison_(period_, openings_.size(), n) {
    demand_.largest = *watched.setup.time->periodic_change;
    demand_.steps_repeat = advice_.empty();
    if (!slowest_.opening.empty()) demand_.law_contraction = std::exp(-period_ / slowest_.time_constant);
  }

  void begin(const State&) override { note(); }

  void look(const State& level) override {
    auto extremes = comparison_.add(level.time, values_at(level));
    if (!extremes) return;
    for (auto* part : {&extremes->difference, &extremes->range, &extremes->size, &extremes->mean_difference,
                       &extremes->product, &extremes->square})
      for (double& value : *part) value = scene_.processes().largest(value);
    changes_.push_back(change_of(*extremes, comparison_.last_end()));
    const PeriodChange& last = changes_.back();
    const PeriodicStanding standing = this->standing();
    messages_.say(fmt::format(
        "period {:.0f}, to {:g} ms, differs from the one before by {:.3g} % in pressure, {:.3g} % in flow, {:.3g} % in "
        "displacement, of their ranges; {}{}",
        last.end / period_, last.end, 100 * last.pressure, 100 * last.flow, 100 * last.displacement,
        text_of_distance(standing),
        standing.reached            ? fmt::format(": periodic within {:g} %, the run ends", 100 * demand_.largest)
        : standing.limited_by_steps ? ": the run ends"
                                    : ""));
    if (standing.limited_by_steps)
      messages_.warn(
          fmt::format("the run is periodic within {:g} % but for its steps, which leave {:.3g} % from period to "
                      "period that do not fall: {}",
                      100 * demand_.largest, 100 * standing.change, advice_));
    note();
  }

  bool wants_end() const override {
    const PeriodicStanding standing = this->standing();
    return standing.reached || standing.limited_by_steps;
  }

  void end() override {
    if (wants_end()) return;
    const PeriodicStanding standing = this->standing();
    if (changes_.empty())
      return messages_.warn(fmt::format(
          "the run is not periodic within {:g} %: no two periods were compared; continue it with a later time.end",
          100 * demand_.largest));
    messages_.warn(fmt::format(
        "the run is not periodic within {:g} %: its last whole period differs from the one before by {:.3g} %, and {}; "
        "{}continue it with a later time.end{}",
        100 * demand_.largest, 100 * standing.change, text_of_distance(standing), cause(standing),
        standing.more_periods ? fmt::format(", about {} periods later", *standing.more_periods) : ""));
  }

  void keep(RestartArchive& archive) override {
    if (!archive.recalls()) comparison_.share(scene_.processes());
    comparison_.keep(archive);
    if (!archive.wants({"period_changes"})) return;
    std::vector<double> numbers;
    for (const PeriodChange& c : changes_) {
      numbers.insert(numbers.end(), {c.end, c.pressure, c.flow, c.displacement});
      numbers.insert(numbers.end(), c.mean.begin(), c.mean.end());
      // Restart archives hold finite numbers only.
      for (const double left : c.contraction) numbers.push_back(std::isnan(left) ? unknown : left);
    }
    archive.array("period_changes", ArrayKind::alike, numbers);
    changes_.clear();
    for (std::size_t i = 0; i + numbers_of_change <= numbers.size(); i += numbers_of_change) {
      PeriodChange c{numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]};
      for (std::size_t q = 0; q < 3; ++q) {
        c.mean[q] = numbers[i + 4 + q];
        const double left = numbers[i + 7 + q];
        c.contraction[q] = left == unknown ? std::numeric_limits<double>::quiet_NaN() : left;
      }
      changes_.push_back(c);
    }
  }

 private:
  static constexpr double unknown = std::numeric_limits<double>::max();

  PeriodicStanding standing() const { return standing_of(changes_, demand_); }

  /// "its mean is about 4.5 % from the periodic state, to which each period leaves 0.819 of the way"
  std::string text_of_distance(const PeriodicStanding& standing) const {
    if (!standing.distance)
      return changes_.size() < 2 ? "how far the periodic state is shows after the next period"
                                 : "how far the periodic state is does not show yet: the change does not fall";
    std::string left = fmt::format("its mean is about {:.3g} % from the periodic state", 100 * *standing.distance);
    if (!standing.contraction || *standing.contraction <= 0) return left;
    return left + fmt::format(", to which each period leaves {:.3g} of the way", *standing.contraction);
  }

  /// What keeps a run from being periodic, where that is known: "...; " or an empty string.
  std::string cause(const PeriodicStanding& standing) const {
    if (!demand_.steps_repeat && (!standing.distance || *standing.distance <= demand_.largest)) return advice_ + "; ";
    const double periods = slowest_.time_constant / period_;
    if (periods > 1 && standing.contraction && *standing.contraction > 0.5 * demand_.law_contraction)
      return fmt::format("{} remembers {:g} ms, {:.3g} periods (distal times compliance){}; ", slowest_.opening,
                         slowest_.time_constant, periods,
                         start_given_ ? R"(: time.start = "lumped", or another initial_pressure, begins nearer)" : "");
    if (!standing.distance && changes_.size() > 2)
      return fmt::format("the flow may swing by itself, or have another period than {:g} ms; ", period_);
    return "";
  }

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
    std::vector<PeriodChange> until;
    for (const PeriodChange& change : changes_) {
      until.push_back(change);
      const PeriodicStanding then = standing_of(until, demand_);
      nlohmann::json entry{{"end_ms", change.end},
                           {"pressure", change.pressure},
                           {"flow", change.flow},
                           {"displacement", change.displacement}};
      if (then.distance) entry["distance"] = *then.distance;
      if (then.contraction) entry["contraction"] = *then.contraction;
      compared.push_back(std::move(entry));
    }
    const PeriodicStanding now = standing();
    messages_.note("periodicity", {{"period_ms", period_},
                                   {"asked", demand_.largest},
                                   {"reached", now.reached},
                                   {"limited_by_steps", now.limited_by_steps},
                                   {"changes", std::move(compared)}});
  }

  const Scene<n>& scene_;
  Messages& messages_;
  std::vector<std::size_t> openings_;  ///< numbers of those that the mesh has
  double period_;
  bool start_given_;
  PeriodicDemand demand_;
  SlowestLaw slowest_;
  std::string advice_;  ///< on steps that do not repeat; empty: they do
  PeriodComparison comparison_;
  std::vector<PeriodChange> changes_;  ///< of the periods from the second one on
};

}  // namespace

template <int n>
std::unique_ptr<Observer> make_periodicity_observer(const RunView<n>& watched) {
  if (!watched.setup.time || !watched.setup.time->periodic_change) return nullptr;
  std::vector<std::size_t> openings;
  const auto& open = watched.scene.fluid->open_boundaries();
  for (std::size_t i = 0; i < open.size(); ++i)
    if (!open[i].empty()) openings.push_back(i);
  return std::make_unique<PeriodicityObserver<n>>(watched, std::move(openings));
}

#define FSI_INSTANTIATE(n) template std::unique_ptr<Observer> make_periodicity_observer(const RunView<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
