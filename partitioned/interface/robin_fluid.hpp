#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "partitioned/interface/mesh_motion_solver.hpp"
#include "partitioned/interface/sub_problem.hpp"
#include "system/system.hpp"

namespace fsi {

/// The fluid with free velocities on the interface, tied there by a Robin condition: with R_f its momentum rows,
///   R_f(u, p; d_m) + c (u - v) = 0 on the interface,   c per node in kPa mm^2 / (mm/ms), v given.
/// Its domain follows its own interface velocity, d_m = d^(n-1) + dt u there, so that the answer is a function of v
/// alone. Newton's method leaves the shape derivatives out: they are small against the rest.
template <class Element>
class RobinFluid : public NewtonProblem {
 public:
  static constexpr int n = Element::components;

  RobinFluid(Scene<Element>& scene, MeshMotionSolver<Element>& mesh_motion,
             const LinearSolverFactory<Element>& make_solver)
      : scene_(scene), mesh_motion_(mesh_motion), numbering_(number_fluid(scene, /*free_interface=*/true)) {
    const JacobianBlocks<Element> blocks{scene, numbering_, &jacobian()};
    if (make_solver)
      solver_ = make_solver(blocks);
    else
      solver_ = std::make_unique<DirectLinearSolver<Element>>(blocks);
  }
  RobinFluid(const RobinFluid&) = delete;  // the solver refers to the numbering
  RobinFluid& operator=(const RobinFluid&) = delete;

  /// \param impedance  c of the step, per interface node; a change of it asks for a new Jacobian
  void work_on(State& state, const StepData& data, const std::vector<double>& impedance, CouplingCost& cost) {
    if (impedance_ != impedance) usable_ = false;
    impedance_ = impedance;
    state_ = &state;
    data_ = &data;
    cost_ = &cost;
  }
  /// v of the Robin condition, n numbers per interface node, mm/ms.
  void aim_at(std::vector<double> velocity) { aim_ = std::move(velocity); }

  /// R_f, n + 1 rows per fluid node: on the interface the force of the fluid on the wall.
  const std::vector<double>& fluid_residual() const { return rows_; }
  bool moves(int interface_node) const {
    return numbering_.flow[static_cast<std::size_t>(scene_.interface[interface_node].fluid) * (n + 1)].index >= 0;
  }

  double evaluate() override {
    follow();
    const auto phase = scene_.profile.phase("assembly: fluid residual");
    if (assemble(false).inverted()) return std::numeric_limits<double>::quiet_NaN();
    return norm(residual_);
  }

  void linearise() override {
    {
      const auto phase = scene_.profile.phase("assembly: fluid jacobian");
      assemble(true);
    }
    {
      const auto phase = scene_.profile.phase(std::string(solver_->preparation()) + ": fluid");
      solver_->update();
    }
    point_.now = state_->now;
    point_.rates = data_->rates;
    point_.rates.wall_reference.clear();
    usable_ = true;
  }
  bool linearised() const override { return usable_ && solver_->ready(); }
  const LinearisationPoint& linearisation_point() const { return point_; }
  /// Makes the Jacobian of an earlier step again, bit for bit (restart).
  void linearise_at(const LinearisationPoint& point, const std::vector<double>& impedance) {
    impedance_ = impedance;
    State state;
    state.now = point.now;
    StepData data;
    data.rates = point.rates;
    aim_.assign(scene_.interface.size() * n, 0.0);
    state_ = &state;
    data_ = &data;
    linearise();
    state_ = nullptr;
    data_ = nullptr;
  }

  double solve(double tolerance) override {
    const auto phase = scene_.profile.phase("solve: fluid");
    report_ = solver_->solve(residual_, tolerance, increment_);
    if (!report_.converged) return std::numeric_limits<double>::quiet_NaN();
    scale(-1, increment_);
    return norm(increment_);
  }
  int linear_iterations() const override { return report_.iterations; }
  std::string linear_failure() const override { return report_.failure; }
  void move(double step) override { add_to_field(numbering_.flow, increment_, step, state_->now.flow); }
  double size() const override {
    double sum = 0;
    for (std::size_t i = 0; i < numbering_.flow.size(); ++i)
      if (numbering_.flow[i].index >= 0) sum += state_->now.flow[i] * state_->now.flow[i];
    return std::sqrt(sum);
  }

  /// eps times the norm of |J| |x|: the size of the terms that cancel in the residual.
  double rounding() override {
    const auto& j = jacobian();
    double sum = 0;
    for (int a = 0; a < j.graph->rows(); ++a)
      for (int i = 0; i <= n; ++i) {
        if (numbering_.flow_rows[static_cast<std::size_t>(a) * (n + 1) + i].index < 0) continue;
        double terms = 0;
        for (int at = j.graph->offsets[a]; at < j.graph->offsets[a + 1]; ++at)
          for (int k = 0; k <= n; ++k)
            terms += std::abs(j.block(at)[i * (n + 1) + k] *
                              state_->now.flow[static_cast<std::size_t>(j.graph->columns[at]) * (n + 1) + k]);
        sum += terms * terms;
      }
    return std::numeric_limits<double>::epsilon() * std::sqrt(sum);
  }

 private:
  BlockMatrix<n + 1, n + 1>& jacobian() const { return scene_.fluid->jacobian(FluidDerivatives::flow).flow; }

  /// The domain follows the interface velocity.
  void follow() {
    const Stopwatch watch(cost_->mesh_seconds);
    for (const auto& node : scene_.interface)
      for (int k = 0; k < n; ++k)
        state_->now.mesh[VectorLayout<n>::vector(node.fluid, k)] =
            data_->rates.interface.displacement(state_->now.flow[MixedLayout<n>::vector(node.fluid, k)],
                                                data_->rates.wall_reference[MixedLayout<n>::vector(node.wall, k)]);
    mesh_motion_.solve(state_->now.mesh);
  }

  AssemblyResult assemble(bool derivatives) {
    const auto result = scene_.fluid->assemble(scene_.fluid_input(*state_, data_->rates), data_->opening_pressures,
                                               rows_, derivatives ? FluidDerivatives::flow : FluidDerivatives::none);
    residual_.assign(static_cast<std::size_t>(numbering_.size), 0.0);
    add_to_system(numbering_.flow_rows, rows_, residual_);
    for (std::size_t i = 0; i < scene_.interface.size(); ++i) {
      const int node = scene_.interface[i].fluid;
      const std::size_t first = static_cast<std::size_t>(node) * (n + 1);
      if (numbering_.flow[first].index < 0) continue;
      for (int k = 0; k < n; ++k) {
        residual_[numbering_.flow[first + k].index] += impedance_[i] * (state_->now.flow[first + k] - aim_[i * n + k]);
        if (derivatives) jacobian().block(jacobian().graph->find(node, node))[k * (n + 1) + k] += impedance_[i];
      }
    }
    return result;
  }

  Scene<Element>& scene_;
  MeshMotionSolver<Element>& mesh_motion_;
  std::vector<double> impedance_, aim_;
  Numbering numbering_;
  std::unique_ptr<LinearSolver> solver_;
  LinearReport report_;
  LinearisationPoint point_;
  State* state_ = nullptr;
  const StepData* data_ = nullptr;
  CouplingCost* cost_ = nullptr;
  bool usable_ = false;  ///< the Jacobian belongs to this impedance
  std::vector<double> rows_, residual_, increment_;
};

}  // namespace fsi
