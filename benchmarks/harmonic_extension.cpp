// One harmonic extension of the artery's mesh motion by triangular solves and by iteration, to all digits and to three,
// level by level.
#include <benchmark/benchmark.h>

#include "benchmarks/artery_case.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "host/threads.hpp"
#include "linear/direct/dense_threads.hpp"
#include "mesh_motion/harmonic_extension.hpp"
#include "system/numbering.hpp"

namespace {

using namespace fsi;

void extend(benchmark::State& run, const char* level, bool iterative, double tolerance) {
  set_dense_threads(set_threads(static_cast<int>(run.range(0))));
  const auto scene = build_scene<P1Tetrahedron>(artery("neo-hookean"), generate_artery(artery_level(level)));
  const Numbering numbering = number_mesh_motion(*scene);
  std::vector<char> inner;
  for (const Unknown& unknown : numbering.mesh_rows) inner.push_back(unknown.index >= 0);
  HarmonicExtensionOptions options;
  options.iterative_from = iterative ? 1 : 1 << 30;
  HarmonicExtension<3> extension(scene->mesh_motion, inner, options);
  const State state = moved(*scene);
  std::vector<double> field, zero(inner.size(), 0.0);
  for (auto _ : run) {
    field = state.now.mesh;
    for (std::size_t i = 0; i < field.size(); ++i)
      if (inner[i]) field[i] = 0;
    extension.solve(zero, field, tolerance);
  }
  run.counters["nodes"] = static_cast<double>(numbering.size) / 3;
  run.counters["iterations"] = extension.iterations();
  run.counters["MiB"] = extension.memory_mib();
}

#define FSI_EXTENSION(level)                                             \
  BENCHMARK_CAPTURE(extend, level##_factors, #level, false, 1e-12)       \
      ->Arg(1)                                                           \
      ->Arg(2)                                                           \
      ->UseRealTime()                                                    \
      ->Unit(benchmark::kMillisecond);                                   \
  BENCHMARK_CAPTURE(extend, level##_iteration, #level, true, 1e-12)      \
      ->Arg(1)                                                           \
      ->Arg(2)                                                           \
      ->UseRealTime()                                                    \
      ->Unit(benchmark::kMillisecond);                                   \
  BENCHMARK_CAPTURE(extend, level##_loose_iteration, #level, true, 1e-3) \
      ->Arg(1)                                                           \
      ->Arg(2)                                                           \
      ->UseRealTime()                                                    \
      ->Unit(benchmark::kMillisecond);
FSI_EXTENSION(coarse)
FSI_EXTENSION(intermediate)
FSI_EXTENSION(fine)

}  // namespace

BENCHMARK_MAIN();
