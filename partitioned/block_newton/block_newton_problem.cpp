#include "partitioned/block_newton/block_newton_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/vector_operations.hpp"
#include "fem/dimensions.hpp"
#include "linear_solvers/general_solvers.hpp"
#include "partitioned/interface/gap_pressure.hpp"
#include "partitioned/interface/sub_problem.hpp"
#include "system/newton_stepper.hpp"

namespace fsi {

namespace {

constexpr double pass_share = 0.5;  // of a linear tolerance, for the gap that passes leave; the rest is the media's
constexpr double loosest_answer = 1e-2;  // of a medium to a change of the datum: pairs are as exact as that
constexpr double tightest_answer = 1e-8;
constexpr double rounding_of_gap = 1e-14, rounding_of_load = 1e-13;  // relative: no pass makes less of them

}  // namespace

template <int n>
BlockNewtonProblem<n>::BlockNewtonProblem(Scene<n>& scene, const PartitionedData& options, double stiffness)
    : scene_(scene),
      membrane_(membrane_of(scene)),
      stiffness_(stiffness),
      most_passes_(options.max_iterations),
      fluid_("fluid", scene, number_fluid_and_domain(scene),
             general_solver_factory<n>(options.linear_solver, options.fast), SystemNorm::volumes, &robin_),
      wall_("wall", scene, number_wall(scene), general_solver_factory<n>(options.linear_solver, options.fast)),
      space_(scene.processes(), scene.owned_interface() * n),
      map_(2 * options.quasi_newton.columns, options.quasi_newton.filter, space_) {
  robin_.balanced = true;
  for (const auto& node : scene.interface) robin_.nodes.push_back(node.fluid);
}

template <int n>
std::vector<double> BlockNewtonProblem<n>::impedance_of(const StepRates& rates) const {
  std::vector<double> impedance = membrane_.node_areas;
  scale(stiffness_ * membrane_.impedance(rates.acceleration_factor, rates.interface.period), impedance);
  return impedance;
}

template <int n>
void BlockNewtonProblem<n>::work_on(State& state, StepData& data) {
  state_ = &state;
  data_ = &data;
  robin_.impedance = impedance_of(data.rates);
  fluid_.work_on(state, data);
  wall_.work_on(state, data);
  if (period_ != data.rates.interface.period) map_.clear();
  period_ = data.rates.interface.period;
}

template <int n>
double BlockNewtonProblem<n>::evaluate() {
  double fluid = 0;
  {
    const Stopwatch watch(cost.fluid_seconds);
    fluid = fluid_.evaluate();
  }
  const Stopwatch watch(cost.wall_seconds);
  data_->interface_load.assign(state_->now.wall.size(), 0.0);
  const std::vector<double>& rows = fluid_.fluid_residual();
  for (const auto& node : scene_.interface)
    for (int k = 0; k < n; ++k)
      data_->interface_load[MixedLayout<n>::vector(node.wall, k)] = rows[MixedLayout<n>::vector(node.fluid, k)];
  gap_ = interface_gap();
  residual_ = std::hypot(fluid, wall_.evaluate(), as_force(gap_));
  return residual_;
}

template <int n>
void BlockNewtonProblem<n>::linearise() {
  map_.renew();
  {
    const Stopwatch watch(cost.fluid_seconds);
    fluid_.linearise();
  }
  const Stopwatch watch(cost.wall_seconds);
  wall_.linearise();
}

template <int n>
std::vector<double> BlockNewtonProblem<n>::interface_gap() const {
  std::vector<double> gap(scene_.interface.size() * n);
  for (std::size_t i = 0; i < scene_.interface.size(); ++i)
    for (int k = 0; k < n; ++k) {
      const std::size_t fluid = MixedLayout<n>::vector(scene_.interface[i].fluid, k);
      const std::size_t wall = MixedLayout<n>::vector(scene_.interface[i].wall, k);
      gap[i * n + k] = state_->now.wall[wall] -
                       data_->rates.interface.displacement(state_->now.fluid[fluid], data_->rates.wall_reference[wall]);
    }
  return gap;
}

template <int n>
std::vector<double> BlockNewtonProblem<n>::gap_left() const {
  std::vector<double> left = gap_;
  for (std::size_t i = 0; i < scene_.interface.size(); ++i) {
    const Direction<n> du = fluid_.increment_at(scene_.interface[i].fluid);
    const Direction<n> dd = wall_.increment_at(scene_.interface[i].wall);
    for (int k = 0; k < n; ++k) left[i * n + k] += dd[k] - data_->rates.interface.displacement(du[k], 0.0);
  }
  return left;
}

template <int n>
double BlockNewtonProblem<n>::as_force(const std::vector<double>& displacements) const {
  std::vector<double> forces = displacements;
  for (std::size_t i = 0; i < forces.size(); ++i)
    forces[i] = robin_.impedance[i / n] * data_->rates.interface.velocity_change(forces[i]);
  return space_.norm(forces);
}

template <int n>
double BlockNewtonProblem<n>::load() const {
  std::vector<double> load(scene_.interface.size() * n);
  for (std::size_t i = 0; i < scene_.interface.size(); ++i)
    for (int k = 0; k < n; ++k)
      load[i * n + k] = data_->interface_load[MixedLayout<n>::vector(scene_.interface[i].wall, k)];
  return space_.norm(load);
}

template <int n>
double BlockNewtonProblem<n>::displacement() const {
  std::vector<double> d(scene_.interface.size() * n);
  for (std::size_t i = 0; i < scene_.interface.size(); ++i)
    for (int k = 0; k < n; ++k) d[i * n + k] = state_->now.wall[MixedLayout<n>::vector(scene_.interface[i].wall, k)];
  return space_.norm(d);
}

template <int n>
double BlockNewtonProblem<n>::displacement_increment() const {
  std::vector<double> d(scene_.interface.size() * n);
  for (std::size_t i = 0; i < scene_.interface.size(); ++i) {
    const Direction<n> dd = wall_.increment_at(scene_.interface[i].wall);
    for (int k = 0; k < n; ++k) d[i * n + k] = dd[k];
  }
  return space_.norm(d);
}

template <int n>
double BlockNewtonProblem<n>::relative_gap() const {
  const double size = displacement();
  return size > 0 ? gap() / size : 0.0;
}

template <int n>
double BlockNewtonProblem<n>::relative_pressure() const {
  return relative_gap_pressure(scene_, membrane_, wall_.numbering(), *data_, gap_);
}

template <int n>
double BlockNewtonProblem<n>::gap_pressure() const {
  return mean_gap_pressure(scene_, membrane_, wall_.numbering(),
                           membrane_.push_stiffness(data_->rates.acceleration_factor), gap_);
}

template <int n>
double BlockNewtonProblem<n>::relative_residual() const {
  const double force = load();
  return force > 0 ? residual_ / force : 0.0;
}

template <int n>
double BlockNewtonProblem<n>::solve(double tolerance) {
  linear_iterations_ = 0;
  for (int stiffenings = 0; !solve_by_passes(tolerance); ++stiffenings) {
    if (stiffenings == most_stiffenings) return std::numeric_limits<double>::quiet_NaN();
    stiffness_ *= stiffening;
    robin_.impedance = impedance_of(data_->rates);
    map_.clear();
    const Stopwatch watch(cost.fluid_seconds);
    fluid_.linearise();
  }
  return std::hypot(fluid_.increment_norm(), wall_.increment_norm());
}

template <int n>
bool BlockNewtonProblem<n>::solve_by_passes(double tolerance) {
  if (!first_pass(tolerance)) return false;
  const double part = pass_share * tolerance;
  const double least_gap = rounding_of_gap * displacement(), least_force = rounding_of_load * load();
  std::vector<double> r = gap_left();
  for (int pass = 1;; ++pass) {
    ++cost.passes;
    const double left = space_.norm(r), left_force = as_force(r), force = space_.norm(loads_);
    if (left <= std::max(part * displacement_increment(), least_gap) &&
        left_force <= std::max(part * force, least_force))
      return true;
    if (pass == most_passes_ || !std::isfinite(left)) {
      failure_ = fmt::format("fluid and wall do not agree in {} linear passes", pass);
      return false;
    }
    std::vector<double> dx;
    {
      const Stopwatch watch(cost.algebra_seconds);
      dx = map_.correction(r);
      axpy(1, dx, x_);
    }
    const double accuracy = std::clamp(part * force / as_force(dx), tightest_answer, loosest_answer);
    const int iterations = linear_iterations_;
    if (!next_pass(dx, accuracy)) return false;
    r = gap_left();
    const Stopwatch watch(cost.algebra_seconds);
    map_.learn(r, linear_iterations_ > iterations ? accuracy : 0);
  }
}

template <int n>
bool BlockNewtonProblem<n>::first_pass(double tolerance) {
  x_.assign(scene_.interface.size() * n, 0.0);
  loads_.assign(x_.size(), 0.0);
  {
    const Stopwatch watch(cost.fluid_seconds);
    if (!note(fluid_, std::isfinite(fluid_.solve(tolerance)), cost.fluid_linear)) return false;
  }
  const Stopwatch watch(cost.wall_seconds);
  load_wall();
  return note(wall_, std::isfinite(wall_.solve_with(wall_forces_, tolerance)), cost.wall_linear);
}

template <int n>
bool BlockNewtonProblem<n>::next_pass(const std::vector<double>& dx, double tolerance) {
  {
    const Stopwatch watch(cost.fluid_seconds);
    fluid_forces_.resize(state_->now.fluid.size());
    for (std::size_t i = 0; i < scene_.interface.size(); ++i)
      for (int k = 0; k < n; ++k)
        fluid_forces_[MixedLayout<n>::vector(scene_.interface[i].fluid, k)] =
            -robin_.impedance[i] * data_->rates.interface.velocity_change(dx[i * n + k]);
    if (!note(fluid_, fluid_.answer(fluid_forces_, tolerance), cost.fluid_linear)) return false;
  }
  const Stopwatch watch(cost.wall_seconds);
  load_wall();
  return note(wall_, wall_.answer(wall_forces_, tolerance), cost.wall_linear);
}

template <int n>
void BlockNewtonProblem<n>::load_wall() {
  wall_forces_.resize(state_->now.wall.size());
  for (std::size_t i = 0; i < scene_.interface.size(); ++i) {
    const auto& node = scene_.interface[i];
    const Direction<n> du = fluid_.increment_at(node.fluid);
    for (int k = 0; k < n; ++k) {
      const double load = -robin_.impedance[i] * (du[k] - data_->rates.interface.velocity_change(x_[i * n + k]));
      wall_forces_[MixedLayout<n>::vector(node.wall, k)] = load - loads_[i * n + k];
      loads_[i * n + k] = load;
    }
  }
}

template <int n>
bool BlockNewtonProblem<n>::note(const System<n>& medium, bool solved, int& iterations) {
  iterations += medium.linear_iterations();
  linear_iterations_ += medium.linear_iterations();
  if (!solved)
    failure_ = medium.linear_failure().empty() ? "a linear solver returned a value that is not finite"
                                               : medium.linear_failure();
  return solved;
}

template <int n>
void BlockNewtonProblem<n>::move(double step) {
  fluid_.move(step);
  wall_.move(step);
}

template <int n>
double BlockNewtonProblem<n>::size() const {
  return std::hypot(fluid_.size(), wall_.size());
}

template <int n>
bool BlockNewtonProblem<n>::negligible(double increment, double share) const {
  return fluid_.negligible(increment, share) && wall_.negligible(increment, share);
}

template <int n>
double BlockNewtonProblem<n>::relative_increment() const {
  return std::max(fluid_.relative_increment(), wall_.relative_increment());
}

template <int n>
double BlockNewtonProblem<n>::rounding() {
  // Of the interface's forces, which passes add up.
  constexpr double sums = 16;
  std::vector<double> d(scene_.interface.size() * n), moved(d.size());
  for (std::size_t i = 0; i < scene_.interface.size(); ++i)
    for (int k = 0; k < n; ++k) {
      d[i * n + k] = state_->now.wall[MixedLayout<n>::vector(scene_.interface[i].wall, k)];
      moved[i * n + k] = data_->rates.interface.displacement(
          state_->now.fluid[MixedLayout<n>::vector(scene_.interface[i].fluid, k)], 0.0);
    }
  const double forces = sums * std::numeric_limits<double>::epsilon() * (as_force(d) + as_force(moved) + load());
  return std::hypot(fluid_.rounding(), wall_.rounding(), forces);
}

template <int n>
void BlockNewtonProblem<n>::keep(Memory& memory) {
  memory.number_if_there("block_newton.stiffness", stiffness_);
  memory.number_if_there("block_newton.period", period_);
  keep_linearisation("wall", wall_, memory);
  keep_linearisation("fluid", fluid_, memory,
                     [this](const StepRates& rates) { robin_.impedance = impedance_of(rates); });
  map_.keep(memory, "block_newton");
}

#define FSI_INSTANTIATE(n) template class BlockNewtonProblem<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
