// Elements per second of the coupled residual and Jacobian on the intermediate artery, per thread, and of the media of
// each element alone, linear and Taylor-Hood, on the coarse one.
#include <benchmark/benchmark.h>

#include "benchmarks/artery_case.hpp"
#include "fem/elements.hpp"
#include "fluid/fluid_problem.hpp"
#include "host/threads.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "scene/build_scene.hpp"
#include "wall/wall_problem.hpp"

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
  /// \param jacobian  null: the residual alone
  void fluid(FluidJacobian<3>* jacobian) {
    scene->fluid->assemble(scene->fluid_input(state, data.rates), {}, fluid_residual, jacobian);
  }
  void wall(WallMatrix<3>* jacobian) {
    scene->wall->assemble(scene->wall_input(state, data.rates), 0.0, state.now.wall, wall_residual, jacobian);
  }
};

void rate(benchmark::State& run, std::size_t elements) {
  run.counters["elements/s/thread"] = benchmark::Counter(static_cast<double>(elements) / static_cast<double>(threads()),
                                                         benchmark::Counter::kIsIterationInvariantRate);
}

void fluid(benchmark::State& run, FluidDerivatives derivatives) {
  Setup s("neo-hookean", static_cast<int>(run.range(0)));
  FluidJacobian<3> jacobian(s.scene->fluid->graph(), derivatives);
  for (auto _ : run) s.fluid(derivatives == FluidDerivatives::none ? nullptr : &jacobian);
  rate(run, s.scene->fluid->element_count());
}

void wall(benchmark::State& run, const std::string& material, bool derivatives) {
  Setup s(material, static_cast<int>(run.range(0)));
  WallMatrix<3> jacobian(s.scene->wall->graph());
  for (auto _ : run) s.wall(derivatives ? &jacobian : nullptr);
  rate(run, s.scene->wall->element_count());
}

void coupled(benchmark::State& run, const std::string& material) {
  Setup s(material, static_cast<int>(run.range(0)));
  FluidJacobian<3> of_fluid(s.scene->fluid->graph(), FluidDerivatives::fluid_and_domain);
  WallMatrix<3> of_wall(s.scene->wall->graph());
  for (auto _ : run) {
    s.fluid(&of_fluid);
    s.wall(&of_wall);
  }
  rate(run, s.scene->fluid->element_count() + s.scene->wall->element_count());
}

/// One region of the coarse artery as a part of its own, and arrays at a deformed, flowing state.
template <class Element>
struct Medium {
  static constexpr int n = Element::components;
  Submesh<Element::dim, Element::order> part;
  std::vector<double> displacement, mixed, zero, residual;

  explicit Medium(int region) {
    set_threads(1);
    const auto linear = generate_artery(artery_level("coarse"));
    if constexpr (Element::order == 1) {
      part = submesh(linear, {region});
    } else {
      part = submesh(with_mid_edge_nodes(linear), {region});
    }
    displacement.resize(VectorLayout<n>::size(part.node_count()));
    mixed.resize(MixedLayout<n>::size(part.node_count()));
    zero.resize(mixed.size());
    for (int a = 0; a < part.node_count(); ++a)
      for (int k = 0; k < n; ++k) {
        const Point& x = part.nodes[a];
        const double wave = std::sin(0.7 * x[0] + 0.4 * x[1] + 0.3 * x[2] + k);
        displacement[VectorLayout<n>::vector(a, k)] = 0.01 * wave;
        mixed[MixedLayout<n>::vector(a, k)] = 0.02 * wave;
      }
  }
};

template <class Element>
void fluid_of(benchmark::State& run, FluidDerivatives derivatives) {
  Medium<Element> s(0);
  FluidProblem<Element> fluid(s.part, {1.0, 3.5e-3}, {});
  FluidInput in;
  in.mesh = s.displacement.data();
  in.mesh_reference = s.zero.data();
  in.fluid = s.mixed.data();
  in.fluid_reference = s.zero.data();
  in.fluid_factor = in.mesh_factor = 8;
  in.step = 0.125;
  FluidJacobian<Element::components> jacobian(fluid.graph(), derivatives);
  for (auto _ : run) fluid.assemble(in, {}, s.residual, &jacobian);
  rate(run, s.part.cells.size());
}

template <class Element>
void wall_of(benchmark::State& run, const Material& material) {
  Medium<Element> s(1);
  WallProblem<Element> wall(s.part, {1.2, 1e5, 0.5}, {{1, material}}, {});
  const WallInput in{s.mixed.data(), s.zero.data(), 64.0};
  WallMatrix<Element::components> jacobian(wall.graph());
  for (auto _ : run) wall.assemble(in, 0.0, s.mixed, s.residual, &jacobian);
  rate(run, s.part.cells.size());
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

void fluid_p1(benchmark::State& run, FluidDerivatives derivatives) {
  fluid_of<P1Tetrahedron>(run, derivatives);
}
void fluid_p2p1(benchmark::State& run, FluidDerivatives derivatives) {
  fluid_of<P2P1Tetrahedron>(run, derivatives);
}
void wall_p1(benchmark::State& run, const Material& material) {
  wall_of<P1Tetrahedron>(run, material);
}
void wall_p2p1(benchmark::State& run, const Material& material) {
  wall_of<P2P1Tetrahedron>(run, material);
}

#define FSI_ELEMENT(...) BENCHMARK_CAPTURE(__VA_ARGS__)->UseRealTime()->Unit(benchmark::kMillisecond)
FSI_ELEMENT(fluid_p1, residual, FluidDerivatives::none);
FSI_ELEMENT(fluid_p1, full_jacobian, FluidDerivatives::fluid_and_domain);
FSI_ELEMENT(fluid_p2p1, residual, FluidDerivatives::none);
FSI_ELEMENT(fluid_p2p1, flow_jacobian, FluidDerivatives::fluid);
FSI_ELEMENT(fluid_p2p1, full_jacobian, FluidDerivatives::fluid_and_domain);
FSI_ELEMENT(wall_p1, neo_hookean, NeoHookean{3});
FSI_ELEMENT(wall_p2p1, neo_hookean, NeoHookean{3});
FSI_ELEMENT(wall_p1, artery, Artery{3, 2.3632, 0.8393, 1, 29});
FSI_ELEMENT(wall_p2p1, artery, Artery{3, 2.3632, 0.8393, 1, 29});

}  // namespace

BENCHMARK_MAIN();
