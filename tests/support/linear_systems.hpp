#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "scene/newton_stepper.hpp"
#include "support/scenes.hpp"

namespace fsi::test {

/// The linearised coupled equations of a later Newton iteration of a later time step: all blocks of the Jacobian differ
/// from zero, the shape derivatives too.
template <class Element>
class LinearisedScene {
 public:
  /// \param finished_steps  time steps before the one whose second Newton system this is
  LinearisedScene(Case setup, std::unique_ptr<Scene<Element>> scene, int finished_steps)
      : setup_(std::move(setup)), scene_(std::move(scene)), loads_(setup_), state_(scene_->at_rest()) {
    if (finished_steps > 0) {
      NewtonOptions newton;
      newton.tolerance = 1e-10;
      NewtonStepper<Element> stepper(*scene_, loads_, newton);
      for (int n = 0; n < finished_steps; ++n) stepper.advance(state_);
    }
    data_ = loads_.next(state_, scene_->scheme);
    scene_->scheme.predict(state_);
    scene_->impose_interface(state_);
    system_ = std::make_unique<System<Element>>("coupled", *scene_, number_scene(*scene_));
    system_->work_on(state_, data_);
    system_->evaluate();
    system_->linearise();
    system_->solve(0);
    system_->move(1);
    system_->evaluate();
    system_->linearise();
    b_ = system_->residual();
    x_.resize(b_.size());
    DirectLinearSolver<Element> direct(blocks());
    direct.update();
    direct.solve(b_, 0, x_);
  }

  const Case& setup() const { return setup_; }
  Scene<Element>& scene() { return *scene_; }
  JacobianBlocks<Element> blocks() { return system_->blocks(); }
  const std::vector<double>& b() const { return b_; }
  /// J^-1 b by sparse factorisation.
  const std::vector<double>& solution() const { return x_; }

 private:
  Case setup_;
  std::unique_ptr<Scene<Element>> scene_;
  Loads loads_;
  State state_;
  StepData data_;
  std::unique_ptr<System<Element>> system_;
  std::vector<double> b_, x_;
};

/// On a box of fluid under a wall of two layers, n cells along the interface.
inline LinearisedScene<P1Tetrahedron>& linearised_box() {
  static LinearisedScene<P1Tetrahedron> box = [] {
    auto setup = coupled_case("artery");
    return LinearisedScene<P1Tetrahedron>(setup, build_scene(setup, fluid_and_wall_box(5)), 2);
  }();
  return box;
}

}  // namespace fsi::test
