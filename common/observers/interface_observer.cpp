#include "observers/interface_observer.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "diagnostics/interface_watch.hpp"
#include "fem/dimensions.hpp"

namespace fsi {

namespace {

/// Tractions are evaluated in one of so many steps, since that takes an assembly of both media.
constexpr int weighed_every = 10;
/// Share of the interface's motion or traction above which the user is warned.
constexpr double tolerable_share = 0.01;

template <int n>
class InterfaceObserver : public Observer {
 public:
  explicit InterfaceObserver(const RunView<n>& watched)
      : messages_(watched.messages), watch_(watched.scene), partitioned_(watched.stepper.reports_coupling()) {}

  bool wants_balances() const override { return true; }
  void begin(const State& state) override {
    watch_.begin(state);
    note();
  }
  std::vector<TableRows> after_step(const FinishedStep& step) override {
    watch_.follow(step.state, step.report.balances);
    if ((step.state.step - 1) % weighed_every == 0) {
      watch_.weigh(step.report.balances.back());
      note();
    }
    return {};
  }
  void end() override {
    const InterfaceAgreement found = note();
    const char* remedy = partitioned_ ? "lower partitioned.tolerance, or choose a scheme that iterates"
                                      : "lower the tolerance of [newton]";
    if (found.gap_share() > tolerable_share)
      messages_.warn(
          fmt::format("where they meet, fluid and wall have come apart by {:.3g} mm, {:.2g} % of the interface's "
                      "largest displacement; {}",
                      std::max(found.largest_slip, found.largest_separation), 100 * found.gap_share(), remedy));
    if (found.traction_share() > tolerable_share)
      messages_.warn(fmt::format(
          "where they meet, fluid and wall leave {:.3g} kPa unbalanced in the mean of its steps, {:.2g} % of "
          "the fluid's traction; {}",
          found.lasting_traction, 100 * found.traction_share(), remedy));
  }
  void keep(RestartArchive& archive) override { watch_.keep(archive); }
  const char* phase() const override { return "interface watch"; }

 private:
  /// An entry of the summary.
  InterfaceAgreement note() const {
    const InterfaceAgreement found = watch_.so_far();
    messages_.note("interface", {{"slip_mm", found.slip},
                                 {"largest_slip_mm", found.largest_slip},
                                 {"largest_separation_mm", found.largest_separation},
                                 {"largest_displacement_mm", found.motion},
                                 {"lasting_unbalanced_traction_kPa", found.lasting_traction},
                                 {"largest_unbalanced_traction_kPa", found.largest_traction},
                                 {"largest_traction_kPa", found.traction},
                                 {"weighed_steps", found.weighed_steps}});
    return found;
  }

  Messages& messages_;
  InterfaceWatch<n> watch_;
  bool partitioned_;
};

}  // namespace

template <int n>
std::unique_ptr<Observer> make_interface_observer(const RunView<n>& watched) {
  if (!watched.scene.coupled() || watched.scene.is_static()) return nullptr;
  return std::make_unique<InterfaceObserver<n>>(watched);
}

#define FSI_INSTANTIATE(n) template std::unique_ptr<Observer> make_interface_observer(const RunView<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
