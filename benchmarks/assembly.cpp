// Elements per second of the coupled residual and Jacobian on the intermediate artery, per thread.
#include <benchmark/benchmark.h>

#include "base/threads.hpp"
#include "benchmarks/artery_case.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "scene/build_scene.hpp"

namespace {

using namespace fsi;

struct Setup {
  Case setup;
  std::unique_ptr<Scene<3>> scene;
  State state;
  StepData data;
  std::vector<double> fluid_residual, wall_residual;

  Setup(const std::string& material, int thread_count) : setup(artery(material)) {
    set_threads(thread_count);
    scene = build_scene<P1Tetrahedron>(setup, generate_artery(artery_level("intermediate")));
    state = moved(*scene);
    data.rates = scene->integrator->rates(state, setup.time->step);
  }
  void fluid(FluidDerivatives derivatives) {
    scene->fluid->assemble(scene->fluid_input(state, data.rates), {}, fluid_residual, derivatives);
  }
  void wall(bool derivatives) {
    scene->wall->assemble(scene->wall_input(state, data.rates), 0.0, state.now.wall, wall_residual, derivatives);
  }
};

void rate(benchmark::State& run, std::size_t elements) {
  run.counters["elements/s/thread"] = benchmark::Counter(static_cast<double>(elements) / static_cast<double>(threads()),
                                                         benchmark::Counter::kIsIterationInvariantRate);
}

void fluid(benchmark::State& run, FluidDerivatives derivatives) {
  Setup s("neo-hookean", static_cast<int>(run.range(0)));
  for (auto _ : run) s.fluid(derivatives);
  rate(run, s.scene->fluid->element_count());
}

void wall(benchmark::State& run, const std::string& material, bool derivatives) {
  Setup s(material, static_cast<int>(run.range(0)));
  for (auto _ : run) s.wall(derivatives);
  rate(run, s.scene->wall->element_count());
}

void coupled(benchmark::State& run, const std::string& material) {
  Setup s(material, static_cast<int>(run.range(0)));
  for (auto _ : run) {
    s.fluid(FluidDerivatives::fluid_and_domain);
    s.wall(true);
  }
  rate(run, s.scene->fluid->element_count() + s.scene->wall->element_count());
}

#define FSI_BENCHMARK(...) BENCHMARK_CAPTURE(__VA_ARGS__)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond)
FSI_BENCHMARK(fluid, residual, FluidDerivatives::none);
FSI_BENCHMARK(fluid, residual_and_flow_jacobian, FluidDerivatives::fluid);
FSI_BENCHMARK(fluid, residual_and_full_jacobian, FluidDerivatives::fluid_and_domain);
FSI_BENCHMARK(wall, residual_neo_hookean, "neo-hookean", false);
FSI_BENCHMARK(wall, jacobian_neo_hookean, "neo-hookean", true);
FSI_BENCHMARK(wall, jacobian_mooney_rivlin, "mooney-rivlin", true);
FSI_BENCHMARK(wall, jacobian_artery, "artery", true);
FSI_BENCHMARK(coupled, full_jacobian_neo_hookean, "neo-hookean");
FSI_BENCHMARK(coupled, full_jacobian_artery, "artery");

}  // namespace

BENCHMARK_MAIN();
