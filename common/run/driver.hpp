#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "run/command_line.hpp"
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

/// Something that a program can do with a case in place of a run.
struct OtherTask {
  std::vector<ExtraOption> options;  ///< the command line's options that ask for it
  /// Does it if it was asked for; empty if not, else the exit code.
  std::function<std::optional<int>(const CommandLine& line, const Case& setup)> run;
};

/// The whole of a driver: parse the command line, read case and mesh, build the scene, march it in time, write the
/// results. Returns the exit code.
int run_driver(const std::string& program, const std::string& description, int argc, const char* const* argv,
               const StepperMaker& make_stepper, const OtherTask& other = {});

}  // namespace fsi
