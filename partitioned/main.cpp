#include "linear/choice/general_solvers.hpp"
#include "partitioned/registry.hpp"
#include "run/driver.hpp"
#include "system/newton_stepper.hpp"

namespace fsi {
namespace {

template <int n>
std::unique_ptr<Stepper> stepper(Scene<n>& scene, const Loads& loads, const Case& setup) {
  if (scene.coupled()) return make_coupling_stepper(scene, loads, setup);
  // Nothing to couple: the part that there is, by Newton's method.
  return std::make_unique<NewtonStepper<n>>(scene, loads, setup.newton, number_single_medium(scene),
                                            [&setup](const JacobianBlocks<n>& blocks) {
                                              return make_fast_or_direct(setup.monolithic.linear_solver, setup, blocks);
                                            });
}

}  // namespace
}  // namespace fsi

int main(int argc, char** argv) {
  using namespace fsi;
  return run_driver(
      "fsi-partitioned",
      "Couples fluid and wall, each solved by itself: by default an interface iteration, which exchanges traces alone.",
      argc, argv,
      StepperMakerOf([](auto& scene, const Loads& loads, const Case& setup) { return stepper(scene, loads, setup); }));
}
