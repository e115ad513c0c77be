#pragma once

#include <memory>

#include "case/case.hpp"
#include "scene/loads.hpp"
#include "scene/scene.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// Makes the stepper that tells one driver from another, for scenes of two and of three dimensions.
class StepperMaker {
 public:
  virtual ~StepperMaker() = default;
  virtual std::unique_ptr<Stepper> make(Scene<2>& scene, const Loads& loads, const Case& setup) const = 0;
  virtual std::unique_ptr<Stepper> make(Scene<3>& scene, const Loads& loads, const Case& setup) const = 0;
};

/// The maker that calls `make(scene, loads, setup)`, a function of scenes of either dimension.
template <class Make>
class StepperMakerOf : public StepperMaker {
 public:
  explicit StepperMakerOf(Make make) : make_(make) {}
  std::unique_ptr<Stepper> make(Scene<2>& scene, const Loads& loads, const Case& setup) const override {
    return make_(scene, loads, setup);
  }
  std::unique_ptr<Stepper> make(Scene<3>& scene, const Loads& loads, const Case& setup) const override {
    return make_(scene, loads, setup);
  }

 private:
  Make make_;
};

}  // namespace fsi
