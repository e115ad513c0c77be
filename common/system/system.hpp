#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "solvers/newton.hpp"
#include "system/direct_linear_solver.hpp"
#include "system/linear_solver.hpp"
#include "system/numbering.hpp"

namespace fsi {

/// The data a Jacobian was made from: enough to make the same one again after a restart.
struct LinearisationPoint {
  Solution now;
  StepRates rates;  ///< but for the wall's references and history, which no derivative knows
  double wall_pressure = 0;
};

/// The discrete equations of a scene, or of one of its sub-problems, under a numbering: residual, Jacobian and linear
/// solve, as Newton's method asks for them. Works on a State that it does not own.
template <class Element>
class System : public NewtonProblem {
 public:
  static constexpr int n = Element::components;
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;

  /// \param name         for the profile: "coupled", "fluid", "wall"
  /// \param make_solver  of the linearised equations; none: the direct one
  System(std::string name, Scene<Element>& scene, Numbering numbering,
         const LinearSolverFactory<Element>& make_solver = {})
      : name_(std::move(name)),
        scene_(scene),
        numbering_(std::move(numbering)),
        derivatives_(numbering_.flow.empty()   ? FluidDerivatives::none
                     : numbering_.mesh.empty() ? FluidDerivatives::flow
                                               : FluidDerivatives::flow_and_domain),
        solver_(make_solver ? make_solver(blocks()) : std::make_unique<DirectLinearSolver<Element>>(blocks())),
        increment_(numbering_.size),
        weights_(norm_weights()) {}
  System(const System&) = delete;  // the solver refers to the numbering
  System& operator=(const System&) = delete;

  const Numbering& numbering() const { return numbering_; }
  const std::vector<double>& residual() const { return residual_; }
  const LinearSolver& solver() const { return *solver_; }
  const LinearReport& linear_report() const { return linear_report_; }
  /// The block matrices of the Jacobian, for as long as the system lives.
  JacobianBlocks<Element> blocks() {
    JacobianBlocks<Element> blocks{scene_, numbering_};
    if (!numbering_.wall_rows.empty()) blocks.wall = &scene_.wall->jacobian();
    if (!numbering_.flow_rows.empty()) {
      auto& jacobian = scene_.fluid->jacobian(derivatives_);
      blocks.flow = &jacobian.flow;
      if (!numbering_.mesh.empty()) blocks.shape_derivatives = &jacobian.shape_derivatives;
    }
    if (!numbering_.mesh_rows.empty()) blocks.mesh = &scene_.mesh_motion;
    return blocks;
  }
  const LinearisationPoint& linearisation_point() const { return point_; }
  /// Rows of the fluid's last residual before boundary conditions: on the interface the force of the fluid on the wall.
  const std::vector<double>& fluid_residual() const { return fluid_residual_; }

  /// The state and step that evaluate(), linearise() and move() refer to from now on.
  /// A Jacobian made for other factors than this step's is no longer kept.
  void work_on(State& state, const StepData& data) {
    state_ = &state;
    data_ = &data;
    if (numbering_.follow(data.rates.interface)) weights_ = norm_weights();
    if (rates_differ(data.rates)) usable_ = false;
  }

  double evaluate() override {
    if (!numbering_.mesh_rows.empty()) scene_.renew_constant_operators();
    const auto phase = scene_.profile.phase("assembly: " + name_ + " residual");
    const AssemblyResult result = assemble(false);
    if (result.inverted()) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0;
    for (double r : residual_) sum += r * r;
    return std::sqrt(sum);
  }

  void linearise() override {
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
    point_.rates.wall_reference.clear();
    point_.wall_pressure = data_->wall_pressure;
    usable_ = true;
  }
  bool linearised() const override { return usable_ && solver_->ready(); }

  /// Makes the Jacobian of an earlier step again, bit for bit (restart).
  void linearise_at(const LinearisationPoint& point) {
    State state;
    state.now = point.now;
    StepData data;
    data.rates = point.rates;
    data.wall_pressure = point.wall_pressure;
    if (!point.rates.is_static() && scene_.wall)
      data.rates.acceleration_history.assign(scene_.wall->space().vector_size(), 0.0);
    work_on(state, data);
    linearise();
    state_ = nullptr;
    data_ = nullptr;
  }

  double solve(double tolerance) override {
    const auto phase = scene_.profile.phase("solve: " + name_);
    linear_report_ = solver_->solve(residual_, tolerance, increment_);
    if (!linear_report_.converged) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0;
    for (std::size_t i = 0; i < increment_.size(); ++i) {
      increment_[i] = -increment_[i];
      sum += weights_[i] * increment_[i] * increment_[i];
    }
    return std::sqrt(sum);
  }

  double keep_contraction() const override { return solver_->keep_contraction(); }
  int linear_iterations() const override { return linear_report_.iterations; }
  std::string linear_failure() const override { return linear_report_.failure; }

  void move(double step) override {
    if (!numbering_.mesh.empty()) add_to_field(numbering_.mesh, increment_, step, state_->now.mesh);
    if (!numbering_.flow.empty()) add_to_field(numbering_.flow, increment_, step, state_->now.flow);
    if (!numbering_.wall.empty()) add_to_field(numbering_.wall, increment_, step, state_->now.wall);
  }

  double size() const override {
    return std::sqrt(weighted<Vector>(mesh_volumes_, state_->now.mesh, !numbering_.mesh.empty()) +
                     weighted<Mixed>(flow_volumes_, state_->now.flow, !numbering_.flow.empty()) +
                     weighted<Mixed>(wall_volumes_, state_->now.wall, !numbering_.wall.empty()));
  }

  /// eps times the norm of |J| |x|: the size of the terms that cancel in the residual. Wall displacements count as
  /// large as the elements, since stresses are differences of terms of order one (I - I_1/3 C^-1) whatever the strain.
  double rounding() override {
    std::vector<double> x(static_cast<std::size_t>(numbering_.size), 0.0), terms(x.size(), 0.0);
    const auto values = [&](const UnknownMap& map, const std::vector<double>& field) {
      for (std::size_t i = 0; i < map.size(); ++i)
        if (map[i].index >= 0) x[map[i].index] = std::max(x[map[i].index], std::abs(field[i] / map[i].factor));
    };
    values(numbering_.mesh, state_->now.mesh);
    values(numbering_.flow, state_->now.flow);
    values(numbering_.wall, state_->now.wall);
    if (!numbering_.wall.empty())
      for (int node = 0; node < scene_.wall->node_count(); ++node)
        for (int k = 0; k < n; ++k) {
          const Unknown& unknown = numbering_.wall[Mixed::vector(node, k)];
          if (unknown.index >= 0) x[unknown.index] += std::cbrt(wall_volumes_[node]);
        }
    add_absolute_products(x, terms);
    double sum = 0;
    for (double t : terms) sum += t * t;
    return std::numeric_limits<double>::epsilon() * std::sqrt(sum);
  }

 private:
  AssemblyResult assemble(bool derivatives) {
    AssemblyResult result;
    residual_.assign(static_cast<std::size_t>(numbering_.size), 0.0);
    if (!numbering_.mesh_rows.empty()) {
      mesh_residual_.resize(state_->now.mesh.size());
      multiply_mesh_motion<Element>(scene_.mesh_motion, state_->now.mesh, mesh_residual_);
      add_to_system(numbering_.mesh_rows, mesh_residual_, residual_);
    }
    if (!numbering_.flow_rows.empty()) {
      result.include(scene_.fluid->assemble(scene_.fluid_input(*state_, data_->rates), data_->opening_pressures,
                                            fluid_residual_, derivatives ? derivatives_ : FluidDerivatives::none));
      add_to_system(numbering_.flow_rows, fluid_residual_, residual_);
    }
    if (!numbering_.wall_rows.empty()) {
      result.include(scene_.wall->assemble(scene_.wall_input(*state_, data_->rates), data_->wall_pressure,
                                           state_->now.wall, wall_residual_, derivatives));
      if (!data_->interface_load.empty())
        for (std::size_t i = 0; i < wall_residual_.size(); ++i) wall_residual_[i] += data_->interface_load[i];
      add_to_system(numbering_.wall_rows, wall_residual_, residual_);
    }
    return result;
  }

  /// terms += |J| |x| of the Jacobian last assembled.
  void add_absolute_products(const std::vector<double>& x, std::vector<double>& terms) {
    const JacobianBlocks<Element> j = blocks();
    const auto add = [&](const auto& matrix, const UnknownMap& rows, const UnknownMap& columns, bool by_component) {
      constexpr int r = std::decay_t<decltype(matrix)>::rows, c = std::decay_t<decltype(matrix)>::columns;
      const auto& graph = *matrix.graph;
      const int rows_per_node = by_component ? c : r;
      for (int a = 0; a < graph.rows(); ++a)
        for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at)
          for (int i = 0; i < rows_per_node; ++i) {
            const Unknown& row = rows[static_cast<std::size_t>(a) * rows_per_node + i];
            if (row.index < 0) continue;
            double sum = 0;
            for (int k = by_component ? i : 0; k < (by_component ? i + 1 : c); ++k) {
              const Unknown& column = columns[static_cast<std::size_t>(graph.columns[at]) * c + k];
              const double value = matrix.block(at)[by_component ? k : i * c + k];
              if (column.index >= 0) sum += std::abs(value * column.factor) * x[column.index];
            }
            terms[row.index] += std::abs(row.factor) * sum;
          }
    };
    if (j.wall) add(*j.wall, numbering_.wall_rows, numbering_.wall, false);
    if (j.flow) add(*j.flow, numbering_.flow_rows, numbering_.flow, false);
    if (j.shape_derivatives) add(*j.shape_derivatives, numbering_.flow_rows, numbering_.mesh, false);
    if (j.mesh) add(*j.mesh, numbering_.mesh_rows, numbering_.mesh, true);
  }

  template <class Layout>
  static double weighted(const std::vector<double>& volumes, const std::vector<double>& field, bool present) {
    double sum = 0;
    if (present)
      for (std::size_t i = 0; i < field.size(); ++i) sum += volumes[i / Layout::entries] * field[i] * field[i];
    return sum;
  }

  /// Weights per unknown of the squared L2 norm of an increment of all fields ([Langer2018], algorithm 1), mm,
  /// mm/ms and kPa added up as they are (docs/theory.md, section 9.3).
  std::vector<double> norm_weights() {
    std::vector<double> weights(static_cast<std::size_t>(numbering_.size), 0.0);
    const auto add = [&](const UnknownMap& map, const std::vector<double>& volumes, int entries) {
      for (std::size_t i = 0; i < map.size(); ++i)
        if (map[i].index >= 0) weights[map[i].index] += map[i].factor * map[i].factor * volumes[i / entries];
    };
    if ((!numbering_.flow.empty() || !numbering_.mesh.empty()) && flow_volumes_.empty())
      mesh_volumes_ = flow_volumes_ = nodal_volumes<Element>(scene_.fluid->part());
    if (!numbering_.wall.empty() && wall_volumes_.empty()) wall_volumes_ = nodal_volumes<Element>(scene_.wall->part());
    add(numbering_.mesh, mesh_volumes_, Vector::entries);
    add(numbering_.flow, flow_volumes_, Mixed::entries);
    add(numbering_.wall, wall_volumes_, Mixed::entries);
    return weights;
  }

  /// Whether a Jacobian of these rates is another one than that at hand.
  bool rates_differ(const StepRates& rates) const {
    const StepRates& of_jacobian = point_.rates;
    return rates.step != of_jacobian.step || rates.interface.period != of_jacobian.interface.period ||
           rates.flow_factor != of_jacobian.flow_factor || rates.acceleration_factor != of_jacobian.acceleration_factor;
  }

  std::string name_;
  Scene<Element>& scene_;
  Numbering numbering_;
  FluidDerivatives derivatives_;
  std::unique_ptr<LinearSolver> solver_;
  LinearReport linear_report_;
  State* state_ = nullptr;
  const StepData* data_ = nullptr;
  LinearisationPoint point_;
  bool usable_ = false;  ///< the solver's Jacobian belongs to the step's rates
  std::vector<double> residual_, increment_, mesh_residual_, fluid_residual_, wall_residual_;
  std::vector<double> mesh_volumes_, flow_volumes_, wall_volumes_;
  std::vector<double> weights_;
};

}  // namespace fsi
