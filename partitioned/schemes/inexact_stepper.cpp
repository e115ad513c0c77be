#include "partitioned/schemes/inexact_stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "fem/dimensions.hpp"
#include "partitioned/accelerators/makers.hpp"
#include "partitioned/interface/dirichlet_neumann.hpp"
#include "partitioned/interface/inexact_robin_neumann.hpp"
#include "partitioned/scheme_checks.hpp"

namespace fsi {

namespace {

/// Newton iterations of each medium in a pass at most, and the part of its residual that ends them sooner: of the first
/// pass, which finds the fields far from where they go, of later ones, and of those that come late.
constexpr PassAccuracy first_pass{0, false, 3, 0.01}, later_passes{0, false, 1, 0.15}, late_passes{0, false, 4, 0.02};
constexpr int late = 15;  // passes: more than nearly all steps take
/// Of what is demanded, where the load has jumped, or nothing was before: later steps change less than that one, and
/// what it leaves is large beside them.
constexpr double share_after_jump = 0.1;
constexpr std::size_t patience = 12;  // passes before stagnation is looked for,
constexpr std::size_t window = 6;     // which means that so many passes have not reduced the gap
constexpr double progress = 0.5;      // to this part
constexpr double slowest = 0.9;       // upper bound of the contraction factor in the error estimate
constexpr double unknown = 0.5;       // that factor where there is one change alone
constexpr double at_rest = 0.1;  // of the demand, on gap and pressure: a wall at rest under load may not change at all
constexpr double rounding = 1e-13;  // of the displacement: passes do not reduce a gap further

/// Factor by which the last numbers of a sequence fall, geometric mean of the last two; 0 for a single number.
double rate(const std::vector<double>& of) {
  const std::size_t last = of.size() - 1, back = std::min<std::size_t>(2, last);
  if (back == 0 || !(of[last - back] > 0)) return 0;
  return std::pow(of[last] / of[last - back], 1.0 / static_cast<double>(back));
}

/// Accepted passes are not refined here: a linearised wall would leave its linearisation error in the step.
PassAccuracy with_its_own_wall(PassAccuracy accuracy) {
  accuracy.linearised_wall = false;
  return accuracy;
}

double demand(const Case& setup) {
  if (setup.partitioned.tolerance) return *setup.partitioned.tolerance;
  const NewtonOptions& newton = setup.newton;
  return newton.error_tolerance > 0 ? newton.error_tolerance : newton.tolerance;
}

}  // namespace

template <int n>
InexactStepper<n>::InexactStepper(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme)
    : Base(scene, loads, setup, scheme, std::make_unique<InexactRobinNeumann<n>>(scene, setup.partitioned)),
      options_(setup.partitioned),
      demand_(demand(setup)),
      force_tolerance_(setup.partitioned.force_tolerance),
      loaded_at_rest_(scene.initial_load.has_value()) {
  require_tube(scheme, setup, scene);
  if (!setup.partitioned.tolerance)
    Base::add_choice({"partitioned.tolerance", fmt::format("{:g}", demand_),
                      "a step is solved when its error is estimated to be that part of what the step changes, as "
                      "[newton] demands it"});
}

template <int n>
std::optional<CouplingMethod> InexactStepper<n>::coupling_method() const {
  return CouplingMethod{
      "interface",
      "a pass improves the fluid and then the wall, each by its own solver and by one Newton iteration "
      "as a rule; traces alone cross the interface"};
}

template <int n>
void InexactStepper<n>::keep(RestartArchive& archive) {
  if (archive.recalls() && archive.has("solved_passes") && !solves_) solve_media();
  if (double solved = 1; solves_) archive.number("solved_passes", solved);
  Base::keep(archive);
  Base::keep_jump(archive);
}

template <int n>
PassAccuracy InexactStepper<n>::first_accuracy() {
  gaps_.clear();
  changes_.clear();
  return solves_ ? with_its_own_wall(Base::first_accuracy()) : first_pass;
}

template <int n>
void InexactStepper<n>::next_accuracy(PassAccuracy& accuracy) {
  if (!solves_) {
    accuracy = Base::passes() < late ? later_passes : late_passes;
    return;
  }
  Base::next_accuracy(accuracy);
  accuracy = with_its_own_wall(accuracy);
}

template <int n>
std::string InexactStepper<n>::another_way() {
  if (std::string way = Base::another_way(); !way.empty()) return way;
  if (solves_) return {};
  solve_media();
  return "passes that solve both media, for the rest of the run";
}

template <int n>
void InexactStepper<n>::solve_media() {
  solves_ = true;
  Scene<n>& scene = Base::scene();
  if (determines_pressure(scene)) {
    PartitionedData options = options_;
    options.relaxation.reset();  // named for passes of Robin-Neumann, which do not overshoot
    Base::go_on_by(std::make_unique<DirichletNeumann<n>>(scene, options),
                   accelerators::iqn_ils(options, Base::space()));
  } else {
    Base::go_on_by(std::make_unique<RobinNeumann<n>>(scene, options_),
                   accelerators::robin_iqn(options_, Base::space()));
  }
  scene.profile.count("inexact passes given up");
}

template <int n>
bool InexactStepper<n>::agrees(const State& state, const StepData& data, const GoodPass& good) {
  const CouplingReport& pass = Base::coupling();
  gaps_.push_back(pass.displacement_gap);
  error_ = 1;
  if (!good.found) return pass.displacement_gap == 0;
  changes_.push_back(Base::change_since(state, data, good));
  if (!std::isfinite(changes_.back()))
    changes_.back() = pass.displacement_residual;  // what the step changes is not known
  const double factor = std::min(slowest, std::max(rate(gaps_), changes_.size() > 1 ? rate(changes_) : unknown));
  error_ = changes_.back() * factor / (1 - factor);
  const bool balanced = force_tolerance_ == 0 || pass.force_residual <= force_tolerance_;
  return balanced &&
         (error_ <= (Base::after_jump() ? share_after_jump : 1) * demand_ ||
          (loaded_at_rest_ && std::max(pass.displacement_residual, pass.pressure_residual) <= at_rest * demand_) ||
          pass.displacement_residual <= rounding);
}

template <int n>
bool InexactStepper<n>::leads_nowhere() const {
  return gaps_.size() >= patience && !(gaps_.back() <= progress * gaps_[gaps_.size() - 1 - window]);
}

template <int n>
std::string InexactStepper<n>::distance_from_demand() const {
  return fmt::format("estimated error of the step {:.2e}, wanted {:g}; |d~ - d| / |d~| = {:.2e}", error_, demand_,
                     Base::coupling().displacement_residual);
}

#define FSI_INSTANTIATE(n) template class InexactStepper<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
