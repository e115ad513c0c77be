#include "monolithic/coupled_solvers/multigrid/coupled_multigrid.hpp"

#include <algorithm>
#include <utility>

#include "fem/dimensions.hpp"
#include "linear/krylov/power_iteration.hpp"

namespace fsi {

template <int n>
CoupledMultigrid<n>::CoupledMultigrid(const CoupledSystem<n>& system, const JacobianBlocks<n>& blocks,
                                      const CoupledMultigridOptions& options)
    : mesh_(options.mesh), fluid_(options.fluid), wall_(options.wall) {
  const auto transfers = coarsen_coupled(finest_nodes(system, blocks), options.coarsening);
  std::vector<std::shared_ptr<const NodeTransfer>> mesh, fluid, wall;
  for (const auto& t : transfers) {
    mesh.push_back(t.mesh);
    fluid.push_back(t.fluid);
    wall.push_back(t.wall);
  }
  const auto& finest = system.matrix();
  mesh_.build(*finest.mesh, mesh);
  fluid_.build(*finest.fluid, fluid);
  wall_.build(*finest.wall, wall);

  CoupledMatrix<n> k = finest;
  for (std::size_t l = 0;; ++l) {
    matrices_.push_back(k);
    if (l == transfers.size()) break;
    const auto& t = transfers[l];
    couplings_.push_back(std::make_unique<Couplings>(k, t));
    k = couplings_.back()->coarse(mesh_.matrix(static_cast<int>(l) + 1), fluid_.matrix(static_cast<int>(l) + 1),
                                  wall_.matrix(static_cast<int>(l) + 1));
  }
  transfers_ = transfers;
  make_levels();
  for (auto& c : couplings_) c->update();
}

template <int n>
void CoupledMultigrid<n>::update() {
  mesh_.update();
  fluid_.update();
  wall_.update();
  for (auto& c : couplings_) c->update();
}

template <int n>
void CoupledMultigrid<n>::set_smoothing(const CoupledSmoothingOptions& options) {
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
    auto& level = *levels_[l];
    double omega = options.damping;
    if (omega <= 0) omega = options.safety * damping_for(largest_eigenvalue(level, options.power_iterations));
    const BlockDamping damping{options.mesh_damping, omega, omega};
    level.pre_smoothing.assign(static_cast<std::size_t>(options.pre_smoothing), damping);
    level.post_smoothing.assign(static_cast<std::size_t>(options.post_smoothing), damping);
  }
}

template <int n>
long long CoupledMultigrid<n>::mesh_cycles() const {
  return sum([](const auto& level) { return level.mesh->cycles(); });
}

template <int n>
long long CoupledMultigrid<n>::fluid_cycles() const {
  return sum([](const auto& level) { return level.fluid->cycles(); });
}

template <int n>
long long CoupledMultigrid<n>::wall_cycles() const {
  return sum([](const auto& level) { return level.wall->cycles(); });
}

template <int n>
double CoupledMultigrid<n>::operator_complexity() const {
  double entries = 0;
  for (const auto& k : matrices_) entries += static_cast<double>(k.nonzeros());
  return entries / static_cast<double>(matrices_.front().nonzeros());
}

template <int n>
double CoupledMultigrid<n>::memory_mib() const {
  std::size_t bytes = mesh_.bytes() + fluid_.bytes() + wall_.bytes();
  for (const auto& c : couplings_) bytes += c->bytes();
  return static_cast<double>(bytes) / (1 << 20);
}

template <int n>
CoupledNodes CoupledMultigrid<n>::finest_nodes(const CoupledSystem<n>& system, const JacobianBlocks<n>& blocks) {
  const auto& k = system.matrix();
  CoupledNodes nodes{k.mesh->graph.get(), k.fluid->graph.get(), k.wall->graph.get(), {}, {}, {}, {}, {}, {}};
  nodes.mesh_marks = nodes.flow_marks = NodeMarks(k.fluid_nodes());
  nodes.wall_marks = NodeMarks(k.wall_nodes());
  nodes.mesh_marks.prescribed = whole_nodes<n>(system.constraints().mesh_fixed);
  nodes.flow_marks.prescribed = whole_nodes<n>(system.constraints().velocity_fixed);
  nodes.wall_marks.prescribed = whole_nodes<n>(system.constraints().wall_fixed);
  for (const auto& pair : system.interface())  // unknowns, though their rows are conditions
    nodes.mesh_marks.prescribed[pair.fluid] = nodes.wall_marks.prescribed[pair.wall] = 0;
  for (const InterfacePair& node : *blocks.interface) {
    nodes.mesh_interface.push_back(node.fluid);
    nodes.wall_interface.push_back(node.wall);
    nodes.mesh_marks.interface[node.fluid] = nodes.flow_marks.interface[node.fluid] = 1;
    nodes.wall_marks.interface[node.wall] = 1;
  }
  nodes.fluid_interface = nodes.mesh_interface;
  return nodes;
}

template <int n>
void CoupledMultigrid<n>::make_levels() {
  for (std::size_t l = 0; l < matrices_.size(); ++l) {
    const int at = static_cast<int>(l);
    levels_.push_back(std::make_unique<CoupledLevel<n>>(
        matrices_[l], std::make_unique<AmgSubSolver<EllipticAmg<n, n>>>(mesh_, at),
        std::make_unique<AmgSubSolver<SaddleAmg<MixedLayout<n>::entries>>>(fluid_, at),
        std::make_unique<AmgSubSolver<SaddleAmg<MixedLayout<n>::entries>>>(wall_, at)));
    if (l < transfers_.size()) levels_.back()->coarser = transfers_[l];
  }
}

template <int n>
double CoupledMultigrid<n>::largest_eigenvalue(CoupledLevel<n>& level, int iterations) const {
  constexpr double largest_extrapolation = 0.25;
  CoupledVector &x = level.inner_x, &zero = level.inner_b;
  zero.set_zero();
  RoughSequence rough;
  for (auto* part : {&x.mesh, &x.fluid, &x.wall})
    for (double& value : *part) value = rough();
  const int third = std::max(iterations / 3, 1);
  const auto growth = power_iteration(3 * third, [&] {
    // The wall's part alone: in it displacements of the interface dominate, whatever the units of the others.
    const double before = norm(x.wall);
    level.smoother.sweep(zero, x, {1, 1, 1});
    const double after = norm(x.wall);
    if (!(before > 0 && after > 0)) return 0.0;
    for (auto* part : {&x.mesh, &x.fluid, &x.wall}) scale(1 / after, *part);
    return after / before;
  });
  if (!(growth.back() > 0)) return 0;
  return extrapolated_limit(growth[third - 1], growth[2 * third - 1], growth.back(), largest_extrapolation);
}

#define FSI_INSTANTIATE(n) template class CoupledMultigrid<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
