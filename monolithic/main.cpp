#include "monolithic/coupled_numbering.hpp"
#include "monolithic/linear_solvers.hpp"
#include "run/driver.hpp"
#include "system/newton_stepper.hpp"

namespace fsi {
namespace {

template <int n>
std::unique_ptr<Stepper> stepper(Scene<n>& scene, const Loads& loads, const Case& setup) {
  return std::make_unique<NewtonStepper<n>>(scene, loads, setup.newton, number_scene(scene),
                                            [&setup](const JacobianBlocks<n>& blocks) {
                                              return make_linear_solver(setup.monolithic.linear_solver, setup, blocks);
                                            });
}

}  // namespace
}  // namespace fsi

int main(int argc, char** argv) {
  using namespace fsi;
  return run_driver(
      "fsi-monolithic", "Solves fluid and wall at once by Newton's method.", argc, argv,
      StepperMakerOf([](auto& scene, const Loads& loads, const Case& setup) { return stepper(scene, loads, setup); }));
}
