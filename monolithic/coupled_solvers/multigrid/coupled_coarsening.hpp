#pragma once

#include <vector>

#include "algebra/node_graph.hpp"
#include "case/coupled_multigrid_options.hpp"
#include "monolithic/coupled_solvers/amg/coarsening.hpp"
#include "monolithic/coupled_solvers/multigrid/coupled_cycle.hpp"

namespace fsi {

/// The nodes of one level of the coupled system. Mesh motion and flow have the same nodes on the finest level only.
struct CoupledNodes {
  const NodeGraph *mesh = nullptr, *fluid = nullptr, *wall = nullptr;
  NodeMarks mesh_marks, flow_marks, wall_marks;
  std::vector<int> mesh_interface, fluid_interface, wall_interface;  ///< the same points one by one, clamped ones too
};

/// Transfers diag(P_m, P_f, P_s) from each level to the next. The interface is coarsened once, and its weights are the
/// same in all three fields: P_m = P_f = P_s there, so that the coarse conditions are again d_m = d_s and
/// u = d_s / period. Nodes of mesh and wall off the interface do not interpolate from it: its rows are conditions
/// there, not equations of the sub-problem, and restriction must not add the two up. The flow's rows on it are momentum
/// equations as all others.
/// \returns one entry per coarse level; none where the finest level has at most options.coarsest_nodes fluid and wall
/// nodes
std::vector<CoupledTransfer> coarsen_coupled(CoupledNodes nodes, const CoupledCoarseningOptions& options);

}  // namespace fsi
