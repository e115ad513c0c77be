#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "algebra/vector_operations.hpp"
#include "linear/krylov/richardson.hpp"
#include "monolithic/coupled_solvers/amg/elliptic_amg.hpp"
#include "monolithic/coupled_solvers/amg/saddle_amg.hpp"

namespace fsi {

/// How a hierarchy does as a stand-alone solver, x += cycle(b - A x).
struct MultigridStudy {
  int levels = 0;
  double operator_complexity = 0;
  std::vector<int> nodes;         ///< of each level
  double convergence_factor = 0;  ///< geometric mean over the last five iterations
  int iterations = 0;             ///< to the tolerance
  bool converged = false;
  double relative_residual = 0;
  double seconds_per_cycle = 0;
  double mebibytes = 0;
};

/// Runs a built hierarchy (EllipticAmg or SaddleAmg) on A x = A y for a fixed pseudo-random y, which excites all
/// frequencies.
/// \param entries    unknowns per node
/// \param tolerance  on |b - A x| / |b|
template <class Hierarchy>
MultigridStudy study_multigrid(Hierarchy& amg, std::size_t entries, double tolerance = 1e-9, int max_iterations = 100) {
  MultigridStudy study;
  study.levels = amg.levels();
  study.operator_complexity = amg.operator_complexity();
  study.mebibytes = static_cast<double>(amg.bytes()) / (1 << 20);
  for (int l = 0; l < amg.levels(); ++l) study.nodes.push_back(amg.matrix(l).graph->rows());
  const std::size_t size = static_cast<std::size_t>(study.nodes[0]) * entries;
  std::vector<double> y(size), b(size), x(size, 0.0);
  unsigned seed = 1;
  for (double& v : y) v = static_cast<double>((seed = seed * 1664525u + 1013904223u) >> 8) / (1 << 24) - 0.5;
  amg.multiply(0, y, b);

  Richardson iteration;
  KrylovOptions options;
  options.tolerance = tolerance;
  options.max_iterations = max_iterations;
  double seconds = 0;
  const auto report =
      iteration.solve([&](const std::vector<double>& from, std::vector<double>& to) { amg.multiply(0, from, to); },
                      [&](const std::vector<double>& from, std::vector<double>& to) {
                        const auto start = std::chrono::steady_clock::now();
                        amg.cycle(0, from, to);
                        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
                      },
                      b, x, options);
  study.iterations = report.iterations;
  study.converged = report.converged;
  study.relative_residual = report.relative_residual;
  study.seconds_per_cycle = report.iterations > 0 ? seconds / report.iterations : 0;
  const int last = std::min(5, report.iterations);
  if (last > 0) {
    const auto& history = report.history;
    study.convergence_factor = std::pow(history.back() / history[history.size() - 1 - last], 1.0 / last);
  }
  return study;
}

/// One line of a study over methods.
struct MultigridStudyRow {
  std::string coarsening, smoother, cycle;
  int pre_smoothing = 0, post_smoothing = 0;
  MultigridStudy result;
};

/// What a study varies; the rest comes from the options it is given.
struct MultigridStudyRange {
  std::vector<std::string> coarsenings = coarsening_kinds().names();
  std::vector<std::string> smoothers = saddle_smoother_kinds().names();  ///< for saddle-point problems
  std::vector<std::string> cycles = cycle_kinds().names();
  int max_levels = 4;  ///< hierarchies of 2, 3, ... levels, as far as the problem has nodes for
  double tolerance = 1e-9;
  int max_iterations = 60;
};

namespace detail {

/// Calls run(coarsening, cycle, levels) for the range; run returns the number of levels there were.
template <class Run>
void for_each_hierarchy(const MultigridStudyRange& range, Run run) {
  for (const auto& coarsening : range.coarsenings)
    for (const auto& cycle : range.cycles)
      for (int levels = 2; levels <= range.max_levels; ++levels)
        if (run(coarsening, cycle, levels) < levels) break;
}

}  // namespace detail

/// Runs a saddle-point problem through the range, boundary conditions being imposed in `a`.
template <int Size>
std::vector<MultigridStudyRow> study_saddle_multigrid(const BlockMatrix<Size, Size>& a, const NodeMarks& marks,
                                                      SaddleAmgOptions options, const MultigridStudyRange& range = {}) {
  std::vector<MultigridStudyRow> rows;
  for (const auto& smoother : range.smoothers)
    detail::for_each_hierarchy(range, [&](const std::string& coarsening, const std::string& cycle, int levels) {
      options.smoother = saddle_smoother_kinds().at(smoother);
      options.coarsening = coarsening_kinds().at(coarsening);
      options.cycle.kind = cycle_kinds().at(cycle);
      options.cycle.max_levels = levels;
      options.cycle.coarsest_nodes = 1;
      SaddleAmg<Size> amg(options);
      amg.build(a, marks);
      if (amg.levels() == levels)
        rows.push_back({coarsening, smoother, cycle, options.cycle.pre_smoothing, options.cycle.post_smoothing,
                        study_multigrid(amg, Size, range.tolerance, range.max_iterations)});
      return amg.levels();
    });
  return rows;
}

/// Runs an elliptic problem of `Components` uncoupled components through the range.
template <int Components, int Numbers>
std::vector<MultigridStudyRow> study_elliptic_multigrid(const BlockMatrix<1, Numbers>& a, const NodeMarks& marks,
                                                        EllipticAmgOptions options,
                                                        const MultigridStudyRange& range = {}) {
  std::vector<MultigridStudyRow> rows;
  detail::for_each_hierarchy(range, [&](const std::string& coarsening, const std::string& cycle, int levels) {
    options.coarsening = coarsening_kinds().at(coarsening);
    options.cycle.kind = cycle_kinds().at(cycle);
    options.cycle.max_levels = levels;
    options.cycle.coarsest_nodes = 1;
    EllipticAmg<Components, Numbers> amg(options);
    amg.build(a, marks);
    if (amg.levels() == levels)
      rows.push_back({coarsening, "gauss-seidel", cycle, options.cycle.pre_smoothing, options.cycle.post_smoothing,
                      study_multigrid(amg, Components, range.tolerance, range.max_iterations)});
    return amg.levels();
  });
  return rows;
}

}  // namespace fsi
