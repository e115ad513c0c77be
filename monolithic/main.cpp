#include "driver/driver.hpp"
#include "scene/newton_stepper.hpp"

int main(int argc, char** argv) {
  using namespace fsi;
  return run_driver("fsi-monolithic", "Solves fluid and wall at once by Newton's method.", argc, argv,
                    [](Scene<P1Tetrahedron>& scene, const Loads& loads, const Case& setup) -> std::unique_ptr<Stepper> {
                      NewtonOptions options;
                      options.tolerance = setup.monolithic.newton_tolerance;
                      options.residual_tolerance = setup.monolithic.residual_tolerance;
                      options.max_iterations = setup.monolithic.max_iterations;
                      options.keep_jacobian = setup.monolithic.mode == "kept";
                      return std::make_unique<NewtonStepper<P1Tetrahedron>>(scene, loads, options);
                    });
}
