#include "system/medium_system.hpp"

#include <cassert>
#include <utility>

#include "algebra/vector_operations.hpp"
#include "fem/dimensions.hpp"
#include "parallel/stop_together.hpp"

namespace fsi {

template <int n>
MediumSystem<n>::MediumSystem(std::string name, Scene<n>& scene, Numbering numbering,
                              const LinearSolverFactory<n>& make_solver, SystemNorm norm,
                              const InterfaceImpedance* impedance)
    : Base(std::move(name), scene, std::move(numbering), make_solver, norm), impedance_(impedance) {
  assert(numbering_.has_fluid() != numbering_.has_wall());
}

template <int n>
double MediumSystem<n>::evaluate() {
  if (!std::exchange(keeps_rows_, false) || !Base::has_rows()) return Base::evaluate();
  Base::gather_residual();
  return Base::norm_of_residual(true);
}

template <int n>
double MediumSystem<n>::solve(double tolerance) {
  increment_is_zero_ = false;
  return Base::solve(tolerance);
}

template <int n>
double MediumSystem<n>::solve_with(const std::vector<double>& forces, double tolerance) {
  increment_is_zero_ = false;
  loaded_ = residual_;
  add_forces(forces, loaded_);
  return Base::solve_for(loaded_, tolerance);
}

template <int n>
bool MediumSystem<n>::add_response(const std::vector<double>& forces, double tolerance) {
  stop_together(Base::processes());
  const auto phase = Base::solve_phase();
  loaded_.assign(static_cast<std::size_t>(numbering_.size), 0.0);
  add_forces(forces, loaded_);
  openings_.close_gaps();
  linear_report_ = solver_->solve(loaded_, tolerance, answer_);
  if (!linear_report_.converged) return false;
  openings_.add_answers();
  answer_.resize(numbering_.columns());
  numbering_.update_ghosts(answer_);
  increment_is_zero_ = false;
  for (std::size_t i = 0; i < increment_.size(); ++i) increment_[i] -= answer_[i];
  return true;
}

template <int n>
void MediumSystem<n>::begin_increment() {
  stop_together(Base::processes());
  openings_.set_gaps();
  set_zero(increment_);
  increment_is_zero_ = true;
}

template <int n>
void MediumSystem<n>::correct_increment(const std::vector<double>& z) {
  axpy(-1, z, increment_);
  increment_is_zero_ = false;
}

template <int n>
void MediumSystem<n>::linear_residual(const std::vector<double>& forces, std::vector<double>& residual) {
  if (increment_is_zero_) {
    residual = residual_;
  } else {
    preconditioner()->multiply_whole(increment_, residual);
    axpy(1, residual_, residual);
  }
  add_forces(forces, residual);
}

template <int n>
Direction<n> MediumSystem<n>::increment_at(int node) const {
  const bool of_fluid = numbering_.has_fluid();
  const UnknownMap& map = of_fluid ? numbering_.fluid : numbering_.wall;
  Direction<n> increment{};
  for (int k = 0; k < n; ++k)
    if (const Unknown& unknown = map[Mixed::vector(node, k)]; unknown.index >= 0)
      increment[k] = unknown.factor * increment_[unknown.index];
  if (const auto* axes = (of_fluid ? scene_.fluid_frames : scene_.wall_frames).at(node))
    NodalFrames<n>::to_space(*axes, increment.data());
  return increment;
}

template <int n>
void MediumSystem<n>::add_forces(const std::vector<double>& forces, std::vector<double>& equations) {
  if (numbering_.has_fluid())
    Base::template add_rows<Mixed>(numbering_.fluid_rows, scene_.fluid_frames, forces, equations);
  else
    Base::template add_rows<Mixed>(numbering_.wall_rows, scene_.wall_frames, forces, equations);
}

template <int n>
void MediumSystem<n>::add_further_rows(std::vector<double>& residual) const {
  if (!impedance_) return;
  if (impedance_->medium == InterfaceImpedance::Medium::fluid)
    add_fluid_impedance(residual);
  else
    add_wall_impedance(residual);
}

template <int n>
void MediumSystem<n>::add_further_derivatives(FluidJacobian<n>& fluid, WallMatrix<n>& wall) const {
  if (!impedance_) return;
  if (impedance_->medium == InterfaceImpedance::Medium::fluid)
    add_to_diagonal(fluid.fluid, numbering_.fluid_rows, 1);
  else
    add_to_diagonal(wall, numbering_.wall_rows, data_->rates.interface.rate());
}

template <int n>
void MediumSystem<n>::add_fluid_impedance(std::vector<double>& residual) const {
  assert(impedance_->balanced || impedance_->velocity.size() == impedance_->nodes.size() * n);
  for (std::size_t i = 0; i < impedance_->nodes.size(); ++i) {
    const int node = impedance_->nodes[i];
    Direction<n> slip{};
    if (!impedance_->balanced)
      for (int k = 0; k < n; ++k) slip[k] = state_->now.fluid[Mixed::vector(node, k)] - impedance_->velocity[i * n + k];
    if (const auto* axes = scene_.fluid_frames.at(node)) NodalFrames<n>::to_frame(*axes, slip.data());
    for (int k = 0; k < n; ++k) {
      const Unknown& row = numbering_.fluid_rows[Mixed::vector(node, k)];
      if (row.index < 0) continue;
      if (impedance_->balanced)
        residual[row.index] = 0;
      else
        residual[row.index] += row.factor * impedance_->impedance[i] * slip[k];
    }
  }
}

template <int n>
void MediumSystem<n>::add_wall_impedance(std::vector<double>& residual) const {
  assert(!impedance_->balanced && impedance_->displacement.size() == impedance_->nodes.size() * n);
  const double rate = data_->rates.interface.rate();
  for (std::size_t i = 0; i < impedance_->nodes.size(); ++i) {
    const int node = impedance_->nodes[i];
    Direction<n> beyond{};
    for (int k = 0; k < n; ++k)
      beyond[k] = state_->now.wall[Mixed::vector(node, k)] - impedance_->displacement[i * n + k];
    if (const auto* axes = scene_.wall_frames.at(node)) NodalFrames<n>::to_frame(*axes, beyond.data());
    for (int k = 0; k < n; ++k)
      if (const Unknown& row = numbering_.wall_rows[Mixed::vector(node, k)]; row.index >= 0)
        residual[row.index] += row.factor * (impedance_->impedance[i] * rate) * beyond[k];
  }
}

template <int n>
void MediumSystem<n>::add_to_diagonal(WallMatrix<n>& matrix, const UnknownMap& rows, double factor) const {
  for (std::size_t i = 0; i < impedance_->nodes.size(); ++i) {
    const int node = impedance_->nodes[i];
    for (int k = 0; k < n; ++k) {
      if (rows[Mixed::vector(node, k)].index < 0) continue;
      matrix.block(matrix.graph->find(node, node))[k * Mixed::entries + k] += impedance_->impedance[i] * factor;
    }
  }
}

#define FSI_INSTANTIATE(n) template class MediumSystem<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
