#include "condensed_solver/fast_or_direct.hpp"
#include "driver/driver.hpp"
#include "partitioned/coupling_stepper.hpp"
#include "system/newton_stepper.hpp"

int main(int argc, char** argv) {
  using namespace fsi;
  return run_driver("fsi-partitioned", "Solves fluid and wall in turn until they agree on the interface.", argc, argv,
                    [](Scene<P1Tetrahedron>& scene, const Loads& loads, const Case& setup) -> std::unique_ptr<Stepper> {
                      if (!scene.coupled())  // nothing to couple: the part that there is, by Newton's method
                        return std::make_unique<NewtonStepper<P1Tetrahedron>>(
                            scene, loads, setup.monolithic.newton, number_single_medium(scene),
                            [&setup](const JacobianBlocks<P1Tetrahedron>& blocks) {
                              return make_fast_or_direct(setup.monolithic.linear_solver, setup, blocks);
                            });
                      return std::make_unique<CouplingStepper<P1Tetrahedron>>(scene, loads, setup);
                    });
}
