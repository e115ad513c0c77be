#include "monolithic/coupled_solvers/multigrid/coupled_coarsening.hpp"

#include <memory>
#include <utility>

#include "monolithic/coupled_solvers/amg/galerkin.hpp"

namespace fsi {

namespace {

/// One field's step to the next level.
struct Step {
  std::shared_ptr<const NodeTransfer> transfer;
  NodeGraph graph;
  NodeMarks marks;
  std::vector<int> interface;
};

Step step(const NodeGraph& graph, const NodeMarks& marks, const std::vector<int>& interface,
          const NodeTransfer& surface, const CoarseningOptions& options) {
  Coarsening coarse = extend_interface(graph, marks, interface, surface, options);
  Step next;
  next.marks = std::move(coarse.marks);
  next.interface = std::move(coarse.coarse_interface);
  next.transfer = std::make_shared<const NodeTransfer>(std::move(coarse.transfer));
  next.graph = galerkin_graph(graph, *next.transfer, *next.transfer);
  return next;
}

}  // namespace

std::vector<CoupledTransfer> coarsen_coupled(CoupledNodes nodes, const CoupledCoarseningOptions& options) {
  constexpr double least_reduction = 0.8;  // coarser levels that keep more nodes are not worth having
  std::vector<CoupledTransfer> transfers;
  Step mesh, fluid, wall;  // own the graphs that `nodes` refers to below the finest level
  while (static_cast<int>(transfers.size()) + 1 < options.max_levels &&
         nodes.fluid->rows() + nodes.wall->rows() > options.coarsest_nodes) {
    std::vector<char> prescribed;
    for (int node : nodes.wall_interface) prescribed.push_back(nodes.wall_marks.prescribed[node]);
    const NodeTransfer surface =
        coarsen_interface(interface_graph(*nodes.fluid, nodes.fluid_interface, *nodes.wall, nodes.wall_interface),
                          prescribed, options.kind);
    CoarseningOptions rules;
    rules.kind = options.kind;
    rules.interior_from_interface = true;
    Step next_fluid = step(*nodes.fluid, nodes.flow_marks, nodes.fluid_interface, surface, rules);
    rules.interior_from_interface = false;
    Step next_wall = step(*nodes.wall, nodes.wall_marks, nodes.wall_interface, surface, rules);
    rules.scalar_part = false;
    Step next_mesh = step(*nodes.mesh, nodes.mesh_marks, nodes.mesh_interface, surface, rules);
    if (next_fluid.graph.rows() + next_wall.graph.rows() > least_reduction * (nodes.fluid->rows() + nodes.wall->rows()))
      break;
    fluid = std::move(next_fluid);
    wall = std::move(next_wall);
    mesh = std::move(next_mesh);
    transfers.push_back({mesh.transfer, fluid.transfer, wall.transfer});
    nodes = {&mesh.graph, &fluid.graph,   &wall.graph,     mesh.marks,    fluid.marks,
             wall.marks,  mesh.interface, fluid.interface, wall.interface};
  }
  return transfers;
}

}  // namespace fsi
