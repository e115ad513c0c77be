#include "monolithic/coupled_solvers/block/coupled_system.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "fem/dimensions.hpp"

namespace fsi {

template <int n>
CoupledSystem<n>::CoupledSystem(const JacobianBlocks<n>& blocks) : blocks_(blocks) {
  assert(blocks.coupled());
  const Numbering& numbering = blocks.numbering;
  mesh_ = BlockMatrix<1, n>(blocks.mesh_laplacian->graph);
  fluid_ = BlockMatrix<MixedLayout<n>::entries, MixedLayout<n>::entries>(blocks.fluid->graph);
  fluid_mesh_ = BlockMatrix<MixedLayout<n>::entries, n>(blocks.shape_derivatives->graph);
  wall_ = BlockMatrix<MixedLayout<n>::entries, MixedLayout<n>::entries>(blocks.wall->graph);
  k_ = {&mesh_, &mesh_wall_, &fluid_mesh_, &fluid_, &fluid_wall_, &wall_fluid_, &wall_};
  constraints_.mesh_fixed = without_unknown(numbering.mesh_rows, n);
  constraints_.velocity_fixed = without_unknown(numbering.fluid, MixedLayout<n>::entries);
  wall_zero_ = without_unknown(numbering.wall, MixedLayout<n>::entries);
  mesh_zero_ = without_unknown(numbering.mesh, n);  // columns of interface nodes stay, they are unknowns
  constraints_.wall_fixed = wall_zero_;
  std::vector<int> wall_of(static_cast<std::size_t>(k_.fluid_nodes()), -1),
      fluid_of(static_cast<std::size_t>(k_.wall_nodes()), -1);
  for (const InterfacePair& pair : *blocks.interface) {
    const auto first = wall_zero_.begin() + static_cast<std::ptrdiff_t>(pair.wall) * n;
    if (std::find(first, first + n, 0) == first + n) continue;  // clamped
    interface_.push_back(pair);
    wall_of[pair.fluid] = pair.wall;
    fluid_of[pair.wall] = pair.fluid;
    std::fill_n(constraints_.wall_fixed.begin() + static_cast<std::ptrdiff_t>(pair.wall) * n, n, 1);
  }
  no_pressure_ = without_scalar(numbering.fluid);
  no_wall_pressure_ = without_scalar(numbering.wall);
  mesh_wall_ = tie(wall_of);
  wall_fluid_ = tie(fluid_of);

  // Afs: the wall's momentum rows of the interface nodes.
  auto graph = std::make_shared<NodeGraph>();
  graph->offsets.assign(1, 0);
  for (int wall_node : wall_of) {
    if (wall_node >= 0) {
      const auto& wall = *blocks.wall->graph;
      for (int at = wall.offsets[wall_node]; at < wall.offsets[wall_node + 1]; ++at) {
        graph->columns.push_back(wall.columns[at]);
        traction_.push_back(at);
      }
    }
    graph->offsets.push_back(static_cast<int>(graph->columns.size()));
  }
  fluid_wall_ = BlockMatrix<n, MixedLayout<n>::entries>(std::move(graph));
  fixed_tractions_.assign(constraints_.velocity_fixed.size(), 0);
  for (const InterfacePair& pair : interface_)  // no equations, where the wall is held
    for (int k = 0; k < n; ++k)
      fixed_tractions_[VectorLayout<n>::vector(pair.fluid, k)] = wall_zero_[VectorLayout<n>::vector(pair.wall, k)];
}

template <int n>
void CoupledSystem<n>::update() {
  const double rate = blocks_.numbering.interface.rate();
  const auto one = [](std::size_t) { return 1.0; };
  update_mesh_motion();
  copy(*blocks_.fluid, fluid_);
  impose(fluid_, constraints_.velocity_fixed, constraints_.velocity_fixed, one);
  impose_scalars(fluid_, no_pressure_);
  copy(*blocks_.shape_derivatives, fluid_mesh_);
  impose(fluid_mesh_, constraints_.velocity_fixed, mesh_zero_, [](std::size_t) { return 0.0; });
  for (int a : no_pressure_)
    for (int at = fluid_mesh_.graph->offsets[a]; at < fluid_mesh_.graph->offsets[a + 1]; ++at)
      std::fill_n(fluid_mesh_.block(at) + n * n, n, 0.0);
  const auto tractions = static_cast<std::ptrdiff_t>(traction_.size());
#pragma omp parallel for schedule(static) if (tractions > 20000)
  for (std::ptrdiff_t i = 0; i < tractions; ++i) {
    const double* from = blocks_.wall->block(traction_[i]);
    std::copy(from, from + n * MixedLayout<n>::entries, fluid_wall_.block(static_cast<int>(i)));
  }
  impose(fluid_wall_, fixed_tractions_, wall_zero_, [](std::size_t) { return 0.0; });
  copy(*blocks_.wall, wall_);
  impose(wall_, constraints_.wall_fixed, wall_zero_, [&](std::size_t i) { return wall_zero_[i] ? 1.0 : rate; });
  impose_scalars(wall_, no_wall_pressure_);
}

template <int n>
void CoupledSystem<n>::update_mesh_motion() {
  copy(*blocks_.mesh_laplacian, mesh_);
  impose_diagonal();
}

template <int n>
void CoupledSystem<n>::expand(const std::vector<double>& condensed, CoupledVector& b) const {
  const auto& numbering = blocks_.numbering;
  const auto take = [&](const UnknownMap& rows, std::vector<double>& part) {
    part.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) part[i] = rows[i].index >= 0 ? condensed[rows[i].index] : 0.0;
  };
  take(numbering.mesh_rows, b.mesh);
  take(numbering.fluid_rows, b.fluid);
  take(numbering.wall_rows, b.wall);
  for (const auto& pair : interface_)  // their equation is the flow's
    for (int k = 0; k < n; ++k) b.wall[MixedLayout<n>::vector(pair.wall, k)] = 0;
}

template <int n>
void CoupledSystem<n>::compress(const CoupledVector& x, std::vector<double>& condensed) const {
  const auto& numbering = blocks_.numbering;
  condensed.assign(static_cast<std::size_t>(numbering.size), 0.0);
  const auto give = [&](const UnknownMap& unknowns, const std::vector<double>& part) {
    for (std::size_t i = 0; i < unknowns.size(); ++i)
      if (unknowns[i].index >= 0) condensed[unknowns[i].index] = part[i] / unknowns[i].factor;
  };
  give(numbering.mesh, x.mesh);
  give(numbering.fluid, x.fluid);
  give(numbering.wall, x.wall);  // last: it owns the interface
}

template <int n>
BlockMatrix<1, 1> CoupledSystem<n>::tie(const std::vector<int>& partner) {
  auto graph = std::make_shared<NodeGraph>();
  graph->offsets.assign(1, 0);
  for (int other : partner) {
    if (other >= 0) graph->columns.push_back(other);
    graph->offsets.push_back(static_cast<int>(graph->columns.size()));
  }
  BlockMatrix<1, 1> matrix(std::move(graph));
  std::fill(matrix.values.begin(), matrix.values.end(), -1.0);
  return matrix;
}

template <int n>
std::vector<char> CoupledSystem<n>::without_unknown(const UnknownMap& map, int entries) {
  std::vector<char> flags(map.size() / entries * n);
  for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = map[i / n * entries + i % n].index < 0;
  return flags;
}

template <int n>
std::vector<int> CoupledSystem<n>::without_scalar(const UnknownMap& map) {
  std::vector<int> nodes;
  for (std::size_t a = 0; a < map.size() / MixedLayout<n>::entries; ++a)
    if (map[MixedLayout<n>::scalar(static_cast<int>(a))].index < 0) nodes.push_back(static_cast<int>(a));
  return nodes;
}

template <int n>
void CoupledSystem<n>::impose_scalars(BlockMatrix<MixedLayout<n>::entries, MixedLayout<n>::entries>& matrix,
                                      const std::vector<int>& nodes) {
  const auto& graph = *matrix.graph;
  for (int a : nodes)
    for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at) {
      double* block = matrix.block(at);
      for (int c = 0; c <= n; ++c) block[MixedLayout<n>::in_block(n, c)] = 0;
      if (graph.columns[at] == a) {
        for (int r = 0; r < n; ++r) block[MixedLayout<n>::in_block(r, n)] = 0;
        block[MixedLayout<n>::in_block(n, n)] = 1;
        continue;
      }
      double* other = matrix.block(graph.find(graph.columns[at], a));
      for (int r = 0; r <= n; ++r) other[MixedLayout<n>::in_block(r, n)] = 0;
    }
}

template <int n>
void CoupledSystem<n>::impose_diagonal() {
  const auto& graph = *mesh_.graph;
#pragma omp parallel for schedule(static) if (graph.blocks() > 50000)
  for (int a = 0; a < graph.rows(); ++a)
    for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at)
      for (int k = 0; k < n; ++k)
        if (constraints_.mesh_fixed[VectorLayout<n>::vector(a, k)] ||
            mesh_zero_[VectorLayout<n>::vector(graph.columns[at], k)])
          mesh_.block(at)[k] = graph.columns[at] == a ? 1.0 : 0.0;
}

#define FSI_INSTANTIATE(n) template class CoupledSystem<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
