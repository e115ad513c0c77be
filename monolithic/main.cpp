#include "driver/driver.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "monolithic/linear_solvers.hpp"
#include "monolithic/study/linear_study.hpp"
#include "system/newton_stepper.hpp"

int main(int argc, char** argv) {
  using namespace fsi;
  LinearStudyRequest study;
  return run_driver(
      "fsi-monolithic", "Solves fluid and wall at once by Newton's method.", argc, argv,
      [](Scene<P1Tetrahedron>& scene, const Loads& loads, const Case& setup) -> std::unique_ptr<Stepper> {
        return std::make_unique<NewtonStepper<P1Tetrahedron>>(
            scene, loads, setup.monolithic.newton, number_scene(scene),
            [&setup](const JacobianBlocks<P1Tetrahedron>& blocks) {
              return make_linear_solver(setup.monolithic.linear_solver, setup, blocks);
            });
      },
      {study.options(), [&](const CommandLine& line, const Case& setup) { return study.run(line, setup); }});
}
