#include "system/system.hpp"

#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra/vector_operations.hpp"
#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "linear/interface/direct_linear_solver.hpp"
#include "linear/interface/jacobian_product.hpp"
#include "parallel/stop_together.hpp"

namespace fsi {

template <int n>
System<n>::System(std::string name, Scene<n>& scene, Numbering numbering, const LinearSolverFactory<n>& make_solver,
                  SystemNorm norm)
    : name_(std::move(name)),
      scene_(scene),
      numbering_(std::move(numbering)),
      fluid_jacobian_(make_fluid_jacobian(scene, numbering_)),
      wall_jacobian_(numbering_.has_wall() ? WallMatrix<n>(scene.wall->graph()) : WallMatrix<n>()),
      interface_(interface_pairs(scene)),
      mesh_tangent_(scene.nonlinear_mesh_motion && numbering_.has_mesh()
                        ? MeshMotionTangent<n>(scene.nonlinear_mesh_motion->graph())
                        : MeshMotionTangent<n>()),
      openings_(scene),
      solver_(make_solver ? make_solver(blocks()) : std::make_unique<DirectLinearSolver<n>>(blocks())),
      increment_(numbering_.columns()),
      norms_(scene, numbering_, norm) {
  if (numbering_.has_fluid()) solver_ = openings_.join(blocks(), std::move(solver_));
}

template <int n>
JacobianBlocks<n> System<n>::blocks() const {
  JacobianBlocks<n> blocks{numbering_};
  if (numbering_.has_wall()) {
    blocks.wall = &wall_jacobian_;
    blocks.wall_nodes = &scene_.wall->nodes();
  }
  if (numbering_.has_fluid()) {
    blocks.fluid = &fluid_jacobian_.fluid;
    if (numbering_.has_mesh()) blocks.shape_derivatives = &fluid_jacobian_.shape_derivatives;
    blocks.fluid_nodes = &scene_.fluid->nodes();
  }
  if (numbering_.has_mesh()) {
    if (scene_.nonlinear_mesh_motion)
      blocks.mesh_tangent = &mesh_tangent_;
    else
      blocks.mesh_laplacian = &scene_.mesh_motion;
  }
  if (blocks.fluid && blocks.wall) blocks.interface = &interface_;
  if (!scene_.fluid_frames.empty()) blocks.fluid_frames = &scene_.fluid_frames;
  if (!scene_.wall_frames.empty()) blocks.wall_frames = &scene_.wall_frames;
  blocks.mesh_laplacian_version = &scene_.mesh_motion_assemblies;
  blocks.profile = &scene_.profile;
  return blocks;
}

template <int n>
void System<n>::work_on(State& state, const StepData& data) {
  state_ = &state;
  data_ = &data;
  if (numbering_.follow(data.rates.interface)) norms_.follow_factors();
  if (rates_differ(data.rates)) usable_ = false;
  has_rows_ = false;
}

template <int n>
double System<n>::evaluate() {
  const bool valid = [&] {
    if (numbering_.has_mesh()) scene_.renew_constant_operators();
    const auto phase = scene_.profile.phase("assembly: " + name_ + " residual");
    return !assemble(false).inverted();
  }();
  return norm_of_residual(valid);
}

template <int n>
double System<n>::norm_of_residual(bool valid) {
  double sum = 0;
  for (double r : residual_) sum += r * r;
  if (const double forces = openings_.compare(*state_, *data_); processes().is_first()) sum += forces;
  // One number tells all: not a number where an element of any process is inverted.
  return std::sqrt(processes().sum(valid ? sum : std::numeric_limits<double>::quiet_NaN()));
}

template <int n>
void System<n>::linearise() {
  stop_together(processes());
  {
    const auto phase = scene_.profile.phase("assembly: " + name_ + " jacobian");
    assemble(true);
  }
  {
    const auto phase = scene_.profile.phase(std::string(solver_->preparation()) + ": " + name_);
    solver_->update();
  }
  point_.now = state_->now;
  point_.rates = data_->rates;
  const bool in_time = scene_.wall && !data_->rates.is_static();
  point_.viscous_wall = in_time && scene_.wall->is_viscous();
  point_.branches = in_time && numbering_.has_wall() && scene_.wall->branch_places().entries > 0;
  if (!point_.viscous_wall) point_.rates.wall_reference.clear();  // no derivative depends on it
  if (!point_.branches) point_.rates.branches_reference.clear();
  point_.wall_pressure = data_->wall_pressure;
  point_.support_loads = data_->support_loads;
  if (openings_differ()) point_.opening_pressures = data_->opening_pressures;
  usable_ = true;
}

template <int n>
void System<n>::linearise_at(const LinearisationPoint& point) {
  State state;
  state.now = point.now;
  StepData data;
  data.rates = point.rates;
  data.wall_pressure = point.wall_pressure;
  if (!openings_differ()) data.rates.openings_reference.clear();  // then no derivative depends on them
  data.rates.openings_reference.resize(scene_.openings.size(), 0.0);
  state.now.openings.resize(scene_.openings.size(), 0.0);
  data.support_loads = point.support_loads;
  data.opening_pressures = point.opening_pressures;
  if (!point.rates.is_static() && scene_.wall)
    data.rates.acceleration_history.assign(scene_.wall->space().vector_size(), 0.0);
  work_on(state, data);
  linearise();
  state_ = nullptr;
  data_ = nullptr;
}

template <int n>
double System<n>::solve(double tolerance) {
  return solve_for(residual_, tolerance);
}

template <int n>
double System<n>::solve_for(const std::vector<double>& b, double tolerance) {
  stop_together(processes());
  const auto phase = solve_phase();
  openings_.set_gaps();
  linear_report_ = solver_->solve(b, tolerance, increment_);
  if (!linear_report_.converged) return std::numeric_limits<double>::quiet_NaN();
  openings_.take_increments();
  increment_.resize(numbering_.columns());
  numbering_.update_ghosts(increment_);
  for (double& x : increment_) x = -x;
  return increment_norm();
}

template <int n>
double System<n>::distance(double tolerance) {
  stop_together(processes());
  const auto phase = solve_phase();
  openings_.set_gaps();
  linear_report_ = solver_->solve(residual_, tolerance, answer_);
  if (!linear_report_.converged) return std::numeric_limits<double>::quiet_NaN();
  answer_.resize(numbering_.columns());
  numbering_.update_ghosts(answer_);
  return norms_.of_increment(answer_);
}

template <int n>
void System<n>::move(double step) {
  has_rows_ = false;
  if (numbering_.has_mesh()) add_increment<Vector>(numbering_.mesh, scene_.fluid_frames, step, state_->now.mesh);
  if (numbering_.has_fluid()) add_increment<Mixed>(numbering_.fluid, scene_.fluid_frames, step, state_->now.fluid);
  if (numbering_.has_wall()) add_increment<Mixed>(numbering_.wall, scene_.wall_frames, step, state_->now.wall);
  openings_.add_increments(step, state_->now);
}

template <int n>
template <class Layout>
void System<n>::add_increment(const UnknownMap& map, const NodalFrames<n>& frames, double step,
                              std::vector<double>& field) const {
  add_to_field(map, increment_, step, field);
  for (const int node : frames.nodes()) {  // correction: add_to_field() took components of the frame for those of space
    Direction<n> turned{}, component{};
    for (int k = 0; k < n; ++k)
      if (const Unknown& unknown = map[Layout::vector(node, k)]; unknown.index >= 0)
        component[k] = turned[k] = step * unknown.factor * increment_[unknown.index];
    NodalFrames<n>::to_space(*frames.at(node), turned.data());
    for (int k = 0; k < n; ++k) field[Layout::vector(node, k)] += turned[k] - component[k];
  }
}

template <int n>
template <class Layout>
void System<n>::add_rows(const UnknownMap& map, const NodalFrames<n>& frames, const std::vector<double>& rows,
                         std::vector<double>& equations) {
  if (frames.empty()) {
    add_to_system(map, rows, equations);
    return;
  }
  rows_ = rows;
  frames.template to_frames<Layout>(rows_);
  add_to_system(map, rows_, equations);
}

template <int n>
double System<n>::rounding() {
  const std::vector<double> x = norms_.magnitudes(state_->now);
  std::vector<double> terms(static_cast<std::size_t>(numbering_.size), 0.0);
  add_absolute_products(blocks(), x, terms);
  const double forces = openings_.add_absolute_products(numbering_, x, state_->now, data_->rates.fluid_factor, terms);
  double sum = processes().is_first() ? forces : 0;
  for (double t : terms) sum += t * t;
  return std::numeric_limits<double>::epsilon() * std::sqrt(processes().sum(sum));
}

template <int n>
std::vector<InterfacePair> System<n>::interface_pairs(const Scene<n>& scene) {
  std::vector<InterfacePair> pairs;
  for (const auto& node : scene.interface) pairs.push_back({node.fluid, node.wall});
  return pairs;
}

template <int n>
FluidJacobian<n> System<n>::make_fluid_jacobian(const Scene<n>& scene, const Numbering& numbering) {
  if (!numbering.has_fluid()) return {};
  return {scene.fluid->graph(), numbering.has_mesh() ? FluidDerivatives::fluid_and_domain : FluidDerivatives::fluid};
}

template <int n>
AssemblyResult System<n>::assemble(bool derivatives) {
  AssemblyResult result;
  has_rows_ = false;
  if (numbering_.has_mesh()) {
    mesh_residual_.resize(state_->now.mesh.size());
    if (scene_.nonlinear_mesh_motion) {
      result.include(scene_.nonlinear_mesh_motion->assemble(state_->now.mesh, mesh_residual_,
                                                            derivatives ? &mesh_tangent_ : nullptr));
      if (derivatives) scene_.fluid_frames.turn_blocks(mesh_tangent_);
    } else {
      multiply_mesh_motion<n>(scene_.mesh_motion, state_->now.mesh, mesh_residual_);
    }
  }
  if (numbering_.has_fluid()) {
    assert(scene_.fluid);
    result.include(
        scene_.assemble_fluid(state_->now, *data_, fluid_residual_, derivatives ? &fluid_jacobian_ : nullptr));
    if (derivatives) {
      scene_.fluid_frames.turn_blocks(fluid_jacobian_.fluid);
      if (numbering_.has_mesh()) scene_.fluid_frames.turn_blocks(fluid_jacobian_.shape_derivatives);
      openings_.linearise(state_->now, data_->rates, !numbering_.mesh.empty());
    }
  }
  if (numbering_.has_wall()) {
    assert(scene_.wall);
    result.include(scene_.wall->assemble(scene_.wall_input(state_->now, *data_), data_->wall_pressure, state_->now.wall,
                                         wall_residual_, derivatives ? &wall_jacobian_ : nullptr));
    if (derivatives) scene_.wall_frames.turn_blocks(wall_jacobian_);
  }
  if (derivatives) add_further_derivatives(fluid_jacobian_, wall_jacobian_);
  gather_residual();
  has_rows_ = !result.inverted();
  return result;
}

template <int n>
void System<n>::gather_residual() {
  residual_.assign(static_cast<std::size_t>(numbering_.size), 0.0);
  if (numbering_.has_mesh()) add_rows<Vector>(numbering_.mesh_rows, scene_.fluid_frames, mesh_residual_, residual_);
  if (numbering_.has_fluid()) {
    add_rows<Mixed>(numbering_.fluid_rows, scene_.fluid_frames, fluid_residual_, residual_);
  }
  if (numbering_.has_wall()) {
    if (data_->interface_load.empty()) {
      add_rows<Mixed>(numbering_.wall_rows, scene_.wall_frames, wall_residual_, residual_);
    } else {
      loaded_rows_ = wall_residual_;
      axpy(1, data_->interface_load, loaded_rows_);
      add_rows<Mixed>(numbering_.wall_rows, scene_.wall_frames, loaded_rows_, residual_);
    }
  }
  add_further_rows(residual_);
}

template <int n>
bool System<n>::rates_differ(const StepRates& rates) const {
  const StepRates& of_jacobian = point_.rates;
  return rates.step != of_jacobian.step || rates.interface.period != of_jacobian.interface.period ||
         rates.fluid_factor != of_jacobian.fluid_factor ||
         rates.acceleration_factor != of_jacobian.acceleration_factor ||
         (point_.viscous_wall && rates.strain_lag != of_jacobian.strain_lag);
}

#define FSI_INSTANTIATE(n) template class System<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
