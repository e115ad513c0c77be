// Fill-reducing orderings and pivoting strategies of the direct solver on the coupled system of the artery.
#include <benchmark/benchmark.h>

#include "benchmarks/artery_case.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "host/threads.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "scene/loads.hpp"
#include "system/system.hpp"

namespace {

using namespace fsi;

/// One coupled system with its first Jacobian assembled and analysed.
struct Coupled {
  Case setup = artery("neo-hookean");
  std::unique_ptr<Scene<3>> scene;
  std::unique_ptr<Loads> loads;
  std::unique_ptr<System<3>> system;
  const DirectLinearSolver<3>* solver = nullptr;  ///< the system's
  State state;
  StepData data;

  Coupled(const std::string& level, const DirectSolver::Options& options, int thread_count) {
    set_dense_threads(set_threads(thread_count));
    scene = build_scene<P1Tetrahedron>(setup, generate_artery(artery_level(level)));
    loads = std::make_unique<Loads>(setup);
    system = std::make_unique<System<3>>("coupled", *scene, number_scene(*scene), [&](const JacobianBlocks<3>& blocks) {
      auto direct = std::make_unique<DirectLinearSolver<3>>(blocks, options);
      solver = direct.get();
      return direct;
    });
    state = scene->at_rest();
    data = loads->next(state, *scene->integrator);
    system->work_on(state, data);
    system->evaluate();
    system->linearise();
  }
};

void factorise(benchmark::State& run, const char* level, const char* ordering, const char* strategy) {
  Coupled coupled(level, {ordering, strategy, 0}, static_cast<int>(run.range(0)));
  for (auto _ : run) coupled.system->linearise();
  run.counters["million nonzeros"] = static_cast<double>(coupled.solver->factor_nonzeros()) / 1e6;
}

void solve(benchmark::State& run, const char* level, const char* ordering, const char* strategy) {
  Coupled coupled(level, {ordering, strategy, 0}, static_cast<int>(run.range(0)));
  for (auto _ : run) coupled.system->solve(0);
}

#define FSI_BENCHMARK(...) BENCHMARK_CAPTURE(__VA_ARGS__)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond)
#define FSI_ORDERINGS(routine, level)                                                \
  FSI_BENCHMARK(routine, level##_amd_unsymmetric, #level, "amd", "unsymmetric");     \
  FSI_BENCHMARK(routine, level##_amd_symmetric, #level, "amd", "symmetric");         \
  FSI_BENCHMARK(routine, level##_metis_unsymmetric, #level, "metis", "unsymmetric"); \
  FSI_BENCHMARK(routine, level##_metis_symmetric, #level, "metis", "symmetric");
FSI_ORDERINGS(factorise, coarse)
FSI_ORDERINGS(solve, coarse)
FSI_ORDERINGS(factorise, intermediate)
FSI_ORDERINGS(solve, intermediate)

}  // namespace

BENCHMARK_MAIN();
