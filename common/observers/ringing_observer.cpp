#include "observers/ringing_observer.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "diagnostics/ringing_monitor.hpp"
#include "fem/dimensions.hpp"
#include "observers/observables.hpp"
#include "observers/ringing_remedy.hpp"

namespace fsi {

namespace {

template <int n>
class RingingObserver : public Observer {
 public:
  explicit RingingObserver(const RunView<n>& watched) : watched_(watched), monitor_(watched.scene_time) {}

  std::vector<TableRows> after_step(const FinishedStep& step) override {
    const State& state = step.state;
    solver_error_ = std::max(solver_error_, step.report.solver_error);
    // On the centre line: at the rim of the inlet the pressure is singular and always oscillates.
    const auto pressures =
        centre_line_pressure<n>(watched_.points, state.last_balance().fluid, watched_.scene.processes());
    for (const double p : pressures) largest_pressure_ = std::max(largest_pressure_, std::abs(p));
    const auto amplitude = monitor_.look(state.has_balances() ? state.balance_times[0] : state.time, pressures);
    if (watched_.loads.axis().jumps_at(state.time)) monitor_.restart();
    if (amplitude && *amplitude > amplitude_) say(*amplitude, step);
    return {};
  }

 private:
  void say(double amplitude, const FinishedStep& step) {
    const bool first = amplitude_ == 0;
    amplitude_ = amplitude;
    const std::string said = said_of({amplitude, step.state.time, largest_pressure_, solver_error_,
                                      step.report.coupling.has_value(), watched_.scene.integrator->against_ringing()},
                                     watched_.setup);
    watched_.messages.note("ringing",
                           {{"amplitude_Pa", 1e3 * amplitude}, {"time_ms", step.state.time}, {"said", said}});
    if (first) watched_.messages.warn(said);
  }

  RunView<n> watched_;
  RingingMonitor monitor_;
  double amplitude_ = 0;         ///< kPa, the largest so far
  double largest_pressure_ = 0;  ///< kPa, on the centre line so far
  double solver_error_ = 0;      ///< the largest so far
};

}  // namespace

template <int n>
std::unique_ptr<Observer> make_ringing_observer(const RunView<n>& watched) {
  if (watched.scene.is_static() || watched.points.centre_line.empty()) return nullptr;
  return std::make_unique<RingingObserver<n>>(watched);
}

#define FSI_INSTANTIATE(n) template std::unique_ptr<Observer> make_ringing_observer(const RunView<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
