#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "fem/p1_tetrahedron.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "support/scenes.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test {

/// A Newton system of a time step: of a later iteration all blocks of the Jacobian differ from zero, the shape
/// derivatives too.
template <int n>
class LinearisedScene {
 public:
  /// \param finished_steps  time steps before the one in question
  /// \param iteration       which of its Newton systems, from 1
  LinearisedScene(Case setup, Scene<n>& scene, int finished_steps, int iteration)
      : setup_(std::move(setup)), scene_(scene), loads_(setup_), state_(scene_.at_rest()) {
    if (finished_steps > 0) {
      NewtonOptions newton;
      newton.tolerance = 1e-10;
      NewtonStepper<n> stepper(scene_, loads_, newton, number_scene(scene_));
      for (int step = 0; step < finished_steps; ++step) stepper.advance(state_);
    }
    data_ = loads_.next(state_, *scene_.integrator);
    scene_.integrator->predict(state_, scene_.predictor, data_);
    scene_.impose_interface(state_, data_.rates);
    system_ = std::make_unique<System<n>>("coupled", scene_, number_scene(scene_), made_when_asked());
    system_->work_on(state_, data_);
    for (int k = 1; k <= iteration; ++k) {
      if (k > 1) {
        system_->solve(0);
        system_->move(1);
      }
      system_->evaluate();
      system_->linearise();
    }
  }

  /// The second system of a step, of a scene that this keeps.
  LinearisedScene(Case setup, std::unique_ptr<Scene<n>> scene, int finished_steps)
      : LinearisedScene(std::move(setup), *scene, finished_steps, 2) {
    owned_ = std::move(scene);
  }

  const Case& setup() const { return setup_; }
  Scene<n>& scene() { return scene_; }
  JacobianBlocks<n> blocks() { return system_->blocks(); }
  const std::vector<double>& b() const { return system_->residual(); }
  /// J^-1 b by sparse factorisation.
  const std::vector<double>& solution() {
    if (x_.empty()) {
      DirectLinearSolver<n> direct(blocks());
      direct.update();
      direct.solve(b(), 0, x_);
    }
    return x_;
  }

 private:
  /// The direct solver, which factorises when it has something to solve: not for the last Jacobian.
  static LinearSolverFactory<n> made_when_asked() {
    class Lazy : public LinearSolver {
     public:
      explicit Lazy(const JacobianBlocks<n>& blocks) : direct_(blocks) {}
      void update() override { updated_ = true; }
      bool ready() const override { return updated_; }
      LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override {
        direct_.update();
        return direct_.solve(b, tolerance, x);
      }

     private:
      DirectLinearSolver<n> direct_;
      bool updated_ = false;
    };
    return [](const JacobianBlocks<n>& blocks) { return std::make_unique<Lazy>(blocks); };
  }

  std::unique_ptr<Scene<n>> owned_;
  Case setup_;
  Scene<n>& scene_;
  Loads loads_;
  State state_;
  StepData data_;
  std::unique_ptr<System<n>> system_;
  std::vector<double> x_;
};

/// On a box of fluid under a wall of two layers, five cells along an edge of the interface.
inline LinearisedScene<3>& linearised_box() {
  static LinearisedScene<3> box(coupled_case("artery"),
                                build_scene<P1Tetrahedron>(coupled_case("artery"), fluid_and_wall_box(5)), 2);
  return box;
}

}  // namespace fsi::test
