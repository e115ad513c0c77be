// Elements per second of the coupled residual and Jacobian on the intermediate artery, per thread.
#include <benchmark/benchmark.h>

#include <cmath>

#include "base/threads.hpp"
#include "mesh/artery_generator.hpp"
#include "mesh/renumber.hpp"
#include "scene/build_scene.hpp"

namespace {

using namespace fsi;

MaterialData layer(const std::string& material, double c10) {
  MaterialData data;
  data.material = material;
  data.c10 = c10;
  data.c01 = 0.3;
  data.k1 = 2.3632;
  data.k2 = 0.8393;
  data.alpha = 29;
  return data;
}

Case artery(const std::string& material) {
  Case setup;
  setup.fluid = FluidData{1.0, 3.5e-3, false};
  StructureData wall;
  wall.density = 1.2;
  wall.bulk_modulus = 1e5;
  wall.layers = {{"media", layer(material, 3.0)}, {"adventitia", layer(material, 0.3)}};
  setup.structure = wall;
  setup.inlet = PressureTable{{{0, 1.332}, {0.125, 1.332}, {0.125, 0}}};
  TimeData time;
  time.step = 0.125;
  time.end = 12;
  setup.time = time;
  return setup;
}

/// A deformed, flowing state, smooth in space, so that no term vanishes.
State moved(const Scene<P1Tetrahedron>& scene) {
  State state = scene.at_rest();
  const auto wave = [](const Point& x, int k) { return std::sin(0.7 * x[0] + 0.4 * x[1] + 0.3 * x[2] + k); };
  for (int a = 0; a < scene.fluid->node_count(); ++a)
    for (int k = 0; k < 3; ++k) {
      state.now.mesh[a * 3 + k] = 0.01 * wave(scene.fluid->part().nodes[a], k);
      state.now.flow[a * 4 + k] = 0.5 * wave(scene.fluid->part().nodes[a], k + 3);
    }
  for (int a = 0; a < scene.wall->node_count(); ++a)
    for (int k = 0; k < 3; ++k) state.now.wall[a * 4 + k] = 0.02 * wave(scene.wall->part().nodes[a], k);
  return state;
}

struct Setup {
  Case setup;
  std::unique_ptr<Scene<P1Tetrahedron>> scene;
  State state;
  StepData data;
  std::vector<double> fluid_residual, wall_residual;

  Setup(const std::string& material, int thread_count) : setup(artery(material)) {
    set_threads(thread_count);
    auto mesh = generate_artery(artery_level("intermediate"));
    mesh = renumbered(mesh, reverse_cuthill_mckee(mesh));
    scene = build_scene(setup, mesh);
    state = moved(*scene);
    data.acceleration_history.assign(state.wall_velocity.size(), 0.0);
  }
  void fluid(FluidDerivatives derivatives) {
    scene->fluid->assemble(scene->fluid_input(state), 0.0, fluid_residual, derivatives);
  }
  void wall(bool derivatives) {
    scene->wall->assemble(scene->wall_input(state, data), 0.0, state.now.wall, wall_residual, derivatives);
  }
};

void rate(benchmark::State& run, std::size_t elements) {
  run.counters["elements/s/thread"] = benchmark::Counter(static_cast<double>(elements) / static_cast<double>(threads()),
                                                         benchmark::Counter::kIsIterationInvariantRate);
}

void fluid(benchmark::State& run, FluidDerivatives derivatives) {
  Setup s("neo-hookean", static_cast<int>(run.range(0)));
  for (auto _ : run) s.fluid(derivatives);
  rate(run, s.scene->fluid->part().cells.size());
}

void wall(benchmark::State& run, const std::string& material, bool derivatives) {
  Setup s(material, static_cast<int>(run.range(0)));
  for (auto _ : run) s.wall(derivatives);
  rate(run, s.scene->wall->part().cells.size());
}

void coupled(benchmark::State& run, const std::string& material) {
  Setup s(material, static_cast<int>(run.range(0)));
  for (auto _ : run) {
    s.fluid(FluidDerivatives::flow_and_domain);
    s.wall(true);
  }
  rate(run, s.scene->fluid->part().cells.size() + s.scene->wall->part().cells.size());
}

#define FSI_BENCHMARK(...) BENCHMARK_CAPTURE(__VA_ARGS__)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond)
FSI_BENCHMARK(fluid, residual, FluidDerivatives::none);
FSI_BENCHMARK(fluid, residual_and_flow_jacobian, FluidDerivatives::flow);
FSI_BENCHMARK(fluid, residual_and_full_jacobian, FluidDerivatives::flow_and_domain);
FSI_BENCHMARK(wall, residual_neo_hookean, "neo-hookean", false);
FSI_BENCHMARK(wall, jacobian_neo_hookean, "neo-hookean", true);
FSI_BENCHMARK(wall, jacobian_mooney_rivlin, "mooney-rivlin", true);
FSI_BENCHMARK(wall, jacobian_artery, "artery", true);
FSI_BENCHMARK(coupled, full_jacobian_neo_hookean, "neo-hookean");
FSI_BENCHMARK(coupled, full_jacobian_artery, "artery");

}  // namespace

BENCHMARK_MAIN();
