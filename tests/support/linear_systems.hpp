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
template <class Element>
class LinearisedScene {
 public:
  /// \param finished_steps  time steps before the one in question
  /// \param iteration       which of its Newton systems, from 1
  LinearisedScene(Case setup, Scene<Element::components>& scene, int finished_steps, int iteration)
      : setup_(std::move(setup)), scene_(scene), loads_(setup_), state_(scene_.at_rest()) {
    if (finished_steps > 0) {
      NewtonOptions newton;
      newton.tolerance = 1e-10;
      NewtonStepper<Element::components> stepper(scene_, loads_, newton, number_scene(scene_));
      for (int n = 0; n < finished_steps; ++n) stepper.advance(state_);
    }
    data_ = loads_.next(state_, *scene_.integrator);
    predict(state_, scene_.predictor, data_.time);
    scene_.impose_interface(state_, data_.rates);
    system_ = std::make_unique<System<Element::components>>("coupled", scene_, number_scene(scene_), made_when_asked());
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
  LinearisedScene(Case setup, std::unique_ptr<Scene<Element::components>> scene, int finished_steps)
      : LinearisedScene(std::move(setup), *scene, finished_steps, 2) {
    owned_ = std::move(scene);
  }

  const Case& setup() const { return setup_; }
  Scene<Element::components>& scene() { return scene_; }
  JacobianBlocks<Element::components> blocks() { return system_->blocks(); }
  const std::vector<double>& b() const { return system_->residual(); }
  /// J^-1 b by sparse factorisation.
  const std::vector<double>& solution() {
    if (x_.empty()) {
      DirectLinearSolver<Element::components> direct(blocks());
      direct.update();
      direct.solve(b(), 0, x_);
    }
    return x_;
  }

 private:
  /// The direct solver, which factorises when it has something to solve: not for the last Jacobian.
  static LinearSolverFactory<Element::components> made_when_asked() {
    class Lazy : public LinearSolver {
     public:
      explicit Lazy(const JacobianBlocks<Element::components>& blocks) : direct_(blocks) {}
      void update() override { updated_ = true; }
      bool ready() const override { return updated_; }
      LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override {
        direct_.update();
        return direct_.solve(b, tolerance, x);
      }

     private:
      DirectLinearSolver<Element::components> direct_;
      bool updated_ = false;
    };
    return [](const JacobianBlocks<Element::components>& blocks) { return std::make_unique<Lazy>(blocks); };
  }

  std::unique_ptr<Scene<Element::components>> owned_;
  Case setup_;
  Scene<Element::components>& scene_;
  Loads loads_;
  State state_;
  StepData data_;
  std::unique_ptr<System<Element::components>> system_;
  std::vector<double> x_;
};

/// On a box of fluid under a wall of two layers, five cells along an edge of the interface.
inline LinearisedScene<P1Tetrahedron>& linearised_box() {
  static LinearisedScene<P1Tetrahedron> box(
      coupled_case("artery"), build_scene<P1Tetrahedron>(coupled_case("artery"), fluid_and_wall_box(5)), 2);
  return box;
}

}  // namespace fsi::test
