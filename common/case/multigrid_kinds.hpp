#pragma once

#include "base/name_table.hpp"

namespace fsi {

// Choices of the multigrid methods, each with the table of its names.

/// How coarse nodes and weights are chosen.
enum class CoarseningKind {
  colouring,   ///< red-black colouring of the graph, each fine node averages its coarse neighbours; [Kickinger1998]
  aggregation  ///< disjoint aggregates, weight one; [Vanek1996] before smoothing
};
/// "colouring", "aggregation"
const NameTable<CoarseningKind>& coarsening_kinds();

/// Order in which a multigrid iteration visits the levels.
enum class CycleKind {
  v,  ///< one visit of the coarser level
  w,  ///< two
  k   ///< one or two flexible GMRES iterations on the coarser level, each preconditioned by a cycle (AMLI)
};
/// "v", "w", "k"
const NameTable<CycleKind>& cycle_kinds();
/// "v", "w": cycles that are one linear map, as preconditioners of GMRES must be
const NameTable<CycleKind>& linear_cycle_kinds();

/// Smoothers of velocity-pressure systems; [Braess1997], [Vanka1986].
enum class SaddleSmootherKind { braess_sarazin, vanka };
/// "braess-sarazin", "vanka"
const NameTable<SaddleSmootherKind>& saddle_smoother_kinds();

}  // namespace fsi
