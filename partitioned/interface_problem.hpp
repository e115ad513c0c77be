#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "partitioned/mesh_motion_solver.hpp"
#include "scene/newton_stepper.hpp"

namespace fsi {

/// The Dirichlet-Neumann map of one time step, d -> d~ (design, section 5): mesh motion from the interface displacement
/// d; fluid with u = (d - d^(n-1)) / dt on the interface; the fluid's interface residual as load on the wall; the
/// wall's answer d~. Interface vectors hold n numbers per interface node, zero where the rim is clamped.
template <class Element>
class InterfaceProblem {
 public:
  static constexpr int n = Element::components;

  InterfaceProblem(Scene<Element>& scene, const NewtonOptions& options)
      : scene_(scene),
        options_(options),
        mesh_motion_(scene),
        fluid_("fluid", scene, number_fluid(scene)),
        wall_("wall", scene, number_wall(scene)) {}

  /// Starts a step: state.now holds the first guess.
  void start(State& state, StepData& data) {
    state_ = &state;
    data_ = &data;
    fluid_.work_on(state, data);
    wall_.work_on(state, data);
  }

  /// The wall's displacement on the interface, in state.now.
  std::vector<double> wall_displacement() const {
    std::vector<double> d(scene_.interface.size() * n);
    for (std::size_t i = 0; i < scene_.interface.size(); ++i)
      for (int k = 0; k < n; ++k)
        d[i * n + k] = state_->now.wall[static_cast<std::size_t>(scene_.interface[i].wall) * (n + 1) + k];
    return d;
  }

  /// d~ for d; leaves fluid and wall in state.now.
  /// \param history  receives the convergence history of a sub-problem that fails
  /// \throws ConvergenceError when one does
  std::vector<double> answer(const std::vector<double>& d, std::vector<std::string>& history) {
    impose_on_fluid(d);
    mesh_motion_.solve(state_->now.mesh);
    fluid_iterations += solve("fluid", fluid_, history);
    load_wall();
    wall_iterations += solve("wall", wall_, history);
    return wall_displacement();
  }

  int fluid_iterations = 0, wall_iterations = 0;  ///< Newton iterations so far

  Memory memory() const {
    Memory memory;
    if (fluid_.linearised()) remember("fluid", fluid_.linearisation_point(), memory);
    if (wall_.linearised()) remember("wall", wall_.linearisation_point(), memory);
    return memory;
  }
  void recall(const Memory& memory) {
    LinearisationPoint point;
    if (fsi::recall("fluid", memory, point)) fluid_.linearise_at(point);
    if (fsi::recall("wall", memory, point)) wall_.linearise_at(point);
  }

 private:
  void impose_on_fluid(const std::vector<double>& d) {
    for (std::size_t i = 0; i < scene_.interface.size(); ++i)
      for (int k = 0; k < n; ++k) {
        const std::size_t m = static_cast<std::size_t>(scene_.interface[i].fluid) * n + k;
        state_->now.mesh[m] = d[i * n + k];
        // The velocity of the mesh, so that no fluid crosses the interface whatever the last step's tolerance left.
        state_->now.flow[static_cast<std::size_t>(scene_.interface[i].fluid) * (n + 1) + k] =
            (d[i * n + k] - state_->before[0].mesh[m]) / scene_.scheme.step;
      }
  }

  void load_wall() {
    data_->interface_load.assign(state_->now.wall.size(), 0.0);
    for (const auto& node : scene_.interface)
      for (int k = 0; k < n; ++k)
        data_->interface_load[static_cast<std::size_t>(node.wall) * (n + 1) + k] =
            fluid_.fluid_residual()[static_cast<std::size_t>(node.fluid) * (n + 1) + k];
  }

  int solve(const std::string& name, System<Element>& system, std::vector<std::string>& history) {
    NewtonOptions options = options_;
    options.reference = system.size();
    const NewtonReport report = newton(system, options);
    if (report.converged) return report.count();
    history.push_back(fmt::format("{} sub-problem, first residual {:.3e}", name, report.first_residual));
    append_history(report, history, "  ");
    throw ConvergenceError(fmt::format("the {} sub-problem: Newton's method stopped after {} iterations: {}", name,
                                       report.count(), report.failure),
                           "a smaller partitioned.relaxation or a smaller time.step");
  }

  Scene<Element>& scene_;
  NewtonOptions options_;
  MeshMotionSolver<Element> mesh_motion_;
  System<Element> fluid_, wall_;
  State* state_ = nullptr;
  StepData* data_ = nullptr;
};

}  // namespace fsi
