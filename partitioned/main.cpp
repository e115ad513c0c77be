#include "driver/driver.hpp"
#include "partitioned/fixed_point_stepper.hpp"

int main(int argc, char** argv) {
  using namespace fsi;
  return run_driver("fsi-partitioned", "Solves fluid and wall in turn until they agree on the interface.", argc, argv,
                    [](Scene<P1Tetrahedron>& scene, const Loads& loads, const Case& setup) -> std::unique_ptr<Stepper> {
                      if (!scene.coupled())  // nothing to couple: the part that there is, by Newton's method
                        return std::make_unique<NewtonStepper<P1Tetrahedron>>(scene, loads, NewtonOptions{});
                      return std::make_unique<FixedPointStepper<P1Tetrahedron>>(scene, loads, setup.partitioned);
                    });
}
