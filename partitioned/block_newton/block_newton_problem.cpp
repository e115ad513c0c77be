#include "partitioned/block_newton/block_newton_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra/vector_operations.hpp"
#include "fem/dimensions.hpp"
#include "linear/policy/attempts.hpp"
#include "partitioned/interface/gap_pressure.hpp"
#include "partitioned/interface/sub_problem.hpp"
#include "system/newton_stepper.hpp"

namespace fsi {

namespace {

constexpr double pass_share = 0.5;  // of the linear tolerance, for the gap that passes leave; the rest is the media's
constexpr double loosest_answer = 1e-3;  // tolerance of a medium's response to a change of the datum, and so of pairs
constexpr double tightest_answer = 1e-8;
constexpr int most_directions = 50;  // of the iteration over both media, between two residuals in double precision
constexpr double stalled = 0.95;     // of the residual, left by a correction
constexpr double rounding_of_gap = 1e-14, rounding_of_load = 1e-13;  // relative: passes do not reduce them further

/// demanded / left, at most 1; 1 also where both are zero.
double ratio(double demanded, double left) {
  return left > demanded ? demanded / left : 1;
}

}  // namespace

template <int n>
BlockNewtonProblem<n>::BlockNewtonProblem(Scene<n>& scene, const PartitionedData& options, double stiffness)
    : BlockNewtonProblem(scene, options, stiffness, medium_solvers(scene, options)) {}

template <int n>
BlockNewtonProblem<n>::BlockNewtonProblem(Scene<n>& scene, const PartitionedData& options, double stiffness,
                                          const MediumSolvers<n>& solvers)
    : scene_(scene),
      membrane_(membrane_of(scene)),
      stiffness_(stiffness),
      most_passes_(options.max_iterations),
      fluid_("fluid", scene, number_fluid_and_domain(scene), solvers.fluid, SystemNorm::volumes, &robin_),
      wall_("wall", scene, number_wall(scene), solvers.wall),
      space_(scene.processes(), scene.owned_interface() * n),
      map_(2 * options.quasi_newton.columns, options.quasi_newton.filter, space_),
      joint_(scene, fluid_.numbering(), wall_.numbering()) {
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
  joint_is_current_ = false;
  {
    const Stopwatch watch(cost.wall_seconds);
    wall_.linearise();  // first: by its stiffness the fluid's solver may be chosen
  }
  const Stopwatch watch(cost.fluid_seconds);
  fluid_.linearise();
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
    forces[i] = robin_.impedance[i / n] / stiffness_ * data_->rates.interface.velocity_change(forces[i]);
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
  ++cost.newton_iterations;
  const double former = stiffness_;
  const auto stiffen_datum = [this] { stiffen(stiffening * stiffness_); };
  const bool both_iterate = fluid_.is_iterative() && wall_.is_iterative();
  const Attempts by_passes{[&] { return solve_by_passes(tolerance); }, stiffen_datum, most_stiffenings, {}};
  const Attempts jointly{[&] { return solve_jointly(tolerance); }, stiffen_datum,
                         both_iterate ? most_joint_stiffenings : 0,
                         [&] {
                           if (both_iterate) stiffen(former);
                           return by_passes.run();
                         }};
  if (!jointly.run()) return std::numeric_limits<double>::quiet_NaN();
  return std::hypot(fluid_.increment_norm(), wall_.increment_norm());
}

template <int n>
void BlockNewtonProblem<n>::stiffen(double stiffness) {
  if (stiffness > stiffness_) scene_.profile.count("stiffer Robin conditions");
  stiffness_ = stiffness;
  robin_.impedance = impedance_of(data_->rates);
  map_.clear();
  joint_is_current_ = false;
  const Stopwatch watch(cost.fluid_seconds);
  fluid_.linearise();
}

template <int n>
bool BlockNewtonProblem<n>::solve_jointly(double tolerance) {
  const Media media{fluid_.preconditioner(), wall_.preconditioner()};
  if (media.fluid == nullptr || media.wall == nullptr) return false;
  const auto phase = scene_.profile.phase("solve: fluid and wall");
  if (!joint_is_current_) joint_.update(*media.fluid, *media.wall, robin_.impedance);
  joint_is_current_ = true;
  const double least_gap = rounding_of_gap * displacement(), least_force = rounding_of_load * load();
  x_.assign(scene_.interface.size() * n, 0.0);
  fluid_.begin_increment();
  wall_.begin_increment();
  double first = 0, relative = 1;
  double accuracy = 0, last_demanded = 0;
  double left_out = 0.05;  // of a residual, what a correction leaves for want of shape derivatives
  for (int passes = 0; passes < most_passes_;) {
    find_linear_residual();
    const double size =
        std::hypot(norm(linear_residual_.fluid), norm(linear_residual_.wall), as_force(linear_residual_.gap));
    if (passes == 0 && size == 0) return true;
    if (passes == 0) first = size;
    const double contraction = size / first / relative;
    relative = size / first;
    if (!std::isfinite(relative)) return false;
    // What is demanded over what there is, of the residual and, once there are increments, of the gap beside them.
    double demanded = tolerance / relative;
    if (passes > 0) {
      const double gap = std::max(tolerance * displacement_increment(), least_gap);
      const double force = std::max(tolerance * space_.norm(loads_), least_force);
      demanded = std::min(
          {demanded, ratio(gap, space_.norm(linear_residual_.gap)), ratio(force, as_force(linear_residual_.gap))});
      if (demanded >= 1) return true;
      // A stalled residual is no failure while the gap, a small part of it, still falls.
      if (contraction > stalled && last_demanded > stalled * demanded) return false;
      left_out = contraction > 2 * accuracy ? std::clamp(contraction, 1e-3, 0.2) : 0.2 * left_out;
    }
    last_demanded = demanded;
    accuracy = std::max(0.8 * demanded, 0.5 * left_out);
    const int iterations = correct_jointly(media, accuracy, std::min(most_directions, most_passes_ - passes));
    if (iterations == 0) return false;
    passes += iterations;
  }
  return false;
}

template <int n>
void BlockNewtonProblem<n>::find_linear_residual() {
  loads_.assign(x_.size(), 0.0);
  fluid_forces_.assign(state_->now.fluid.size(), 0.0);
  for (std::size_t i = 0; i < scene_.interface.size(); ++i)
    for (int k = 0; k < n; ++k)
      fluid_forces_[MixedLayout<n>::vector(scene_.interface[i].fluid, k)] =
          -robin_.impedance[i] * data_->rates.interface.velocity_change(x_[i * n + k]);
  load_wall();
  linear_residual_.gap = gap_left();
  {
    const Stopwatch watch(cost.fluid_seconds);
    fluid_.linear_residual(fluid_forces_, linear_residual_.fluid);
  }
  const Stopwatch watch(cost.wall_seconds);
  wall_.linear_residual(wall_forces_, linear_residual_.wall);
}

template <int n>
int BlockNewtonProblem<n>::correct_jointly(const Media& media, double accuracy, int most_iterations) {
  const double fluid = media.fluid->restrict_residual(linear_residual_.fluid, accuracy);
  const double wall = media.wall->restrict_residual(linear_residual_.wall, accuracy);
  std::vector<double> gap(x_.size());  // as a force
  for (std::size_t i = 0; i < x_.size(); ++i)
    gap[i] = robin_.impedance[i / n] * data_->rates.interface.velocity_change(linear_residual_.gap[i]);
  // Scaled to one, so that small residuals do not leave the range of single precision.
  const double scale = std::hypot(fluid, wall, norm(gap));
  if (scale == 0) return 0;
  right_.resize(joint_.layout().size());
  const BlockView<float> right = joint_.layout().view(right_);
  media.fluid->write_restricted(1 / scale, right.fluid);
  media.wall->write_restricted(1 / scale, right.wall);
  for (std::size_t i = 0; i < x_.size(); ++i) right.datum[i] = static_cast<float>(gap[i] / scale);
  const int iterations =
      joint_.solve(right_, accuracy, most_iterations, joint_solution_, {cost.fluid_seconds, cost.wall_seconds});
  const BlockView<float> solution = joint_.layout().view(joint_solution_);
  cost.passes += iterations;
  cost.fluid_linear += iterations;
  cost.wall_linear += iterations;
  linear_iterations_ += 2 * iterations;
  for (std::size_t i = 0; i < x_.size(); ++i)
    x_[i] -= data_->rates.interface.displacement(scale * solution.datum[i], 0.0);
  {
    const Stopwatch watch(cost.fluid_seconds);
    media.fluid->expand(solution.fluid, scale, accuracy, correction_);
    fluid_.correct_increment(correction_);
  }
  const Stopwatch watch(cost.wall_seconds);
  media.wall->expand(solution.wall, scale, accuracy, correction_);
  wall_.correct_increment(correction_);
  return iterations;
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
    if (!note(fluid_, fluid_.add_response(fluid_forces_, tolerance), cost.fluid_linear)) return false;
  }
  const Stopwatch watch(cost.wall_seconds);
  load_wall();
  return note(wall_, wall_.add_response(wall_forces_, tolerance), cost.wall_linear);
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
void BlockNewtonProblem<n>::keep(RestartArchive& archive) {
  archive.number_if_there("block_newton.stiffness", stiffness_);
  archive.number_if_there("block_newton.period", period_);
  keep_linearisation("wall", wall_, archive);
  keep_linearisation("fluid", fluid_, archive,
                     [this](const StepRates& rates) { robin_.impedance = impedance_of(rates); });
  map_.keep(archive, "block_newton");
}

#define FSI_INSTANTIATE(n) template class BlockNewtonProblem<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
