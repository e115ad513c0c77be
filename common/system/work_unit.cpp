#include "system/work_unit.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "algebra/block_products.hpp"
#include "base/stopwatch.hpp"
#include "fem/dimensions.hpp"
#include "fem/nodal_layout.hpp"

namespace fsi {

namespace {

/// Of the rows of a medium's own nodes.
std::int64_t own_blocks(const NodeGraph& graph, const PartNodes& nodes) {
  std::int64_t blocks = 0;
  for (int row = 0; row < graph.rows(); ++row)
    if (nodes.owns(row)) blocks += graph.offsets[row + 1] - graph.offsets[row];
  return blocks;
}

/// rows = A x, or += A x
template <int Rows, int Columns>
void multiply_by(const NodeGraph& graph, const std::vector<double>& values, const std::vector<double>& x,
                 std::vector<double>& rows, bool add) {
  assert(values.size() >= static_cast<std::size_t>(graph.blocks()) * Rows * Columns);
  detail::for_each_block_row<Rows, Columns>(graph, values.data(), x.data(), [&](int row, const double* sum) {
    for (int r = 0; r < Rows; ++r) {
      double& y = rows[static_cast<std::size_t>(row) * Rows + r];
      y = add ? y + sum[r] : sum[r];
    }
  });
}

template <class Layout>
void update_ghosts(const PartNodes& nodes, std::vector<double>& field) {
  if (nodes.share) nodes.share->template update<Layout>(field);
}

}  // namespace

template <int n>
CoupledProduct<n>::CoupledProduct(const Scene<n>& scene) : scene_(scene) {
  if (scene.fluid) fluid_.assign(scene.fluid->space().mixed_size(), 1.0);
  if (scene.coupled()) mesh_.assign(scene.fluid->space().vector_size(), 1.0);
  if (scene.wall) wall_.assign(scene.wall->space().mixed_size(), 1.0);
  fluid_rows_ = fluid_;
  mesh_rows_ = mesh_;
  wall_rows_ = wall_;
}

template <int n>
void CoupledProduct<n>::multiply(const MatrixValues& of_media) {
  constexpr int mixed = MixedLayout<n>::entries;
  if (scene_.fluid) {
    const NodeGraph& graph = *scene_.fluid->graph();
    const std::vector<double>& values = *of_media.fluid;
    update_ghosts<MixedLayout<n>>(scene_.fluid->nodes(), fluid_);
    multiply_by<mixed, mixed>(graph, values, fluid_, fluid_rows_, false);
    if (scene_.coupled()) {
      update_ghosts<VectorLayout<n>>(scene_.fluid->nodes(), mesh_);
      multiply_by<mixed, n>(graph, values, mesh_, fluid_rows_, true);
      if (scene_.nonlinear_mesh_motion)
        multiply_by<n, n>(graph, values, mesh_, mesh_rows_, false);
      else
        detail::for_each_component_row<n, n>(*scene_.mesh_motion.graph, values.data(), mesh_.data(),
                                             [&](int row, const double* sum) {
                                               for (int k = 0; k < n; ++k)
                                                 mesh_rows_[static_cast<std::size_t>(row) * n + k] = sum[k];
                                             });
    }
  }
  if (scene_.wall) {
    update_ghosts<MixedLayout<n>>(scene_.wall->nodes(), wall_);
    multiply_by<mixed, mixed>(*scene_.wall->graph(), *of_media.wall, wall_, wall_rows_, false);
  }
}

template <int n>
std::int64_t CoupledProduct<n>::entries() const {
  constexpr std::int64_t mixed = MixedLayout<n>::entries;
  std::int64_t entries = 0;
  if (scene_.fluid) {
    const PartNodes& nodes = scene_.fluid->nodes();
    const std::int64_t elastic_mesh = scene_.nonlinear_mesh_motion ? n * n : 0;
    const std::int64_t of_pair = mixed * mixed + (scene_.coupled() ? mixed * n + elastic_mesh : 0);
    entries += of_pair * own_blocks(*scene_.fluid->graph(), nodes);
    if (scene_.mesh_motion_problem) entries += n * own_blocks(*scene_.mesh_motion.graph, nodes);
  }
  if (scene_.wall) entries += mixed * mixed * own_blocks(*scene_.wall->graph(), scene_.wall->nodes());
  return scene_.processes().sum(entries);
}

template <int n>
void WorkUnitMeter<n>::measure(double elapsed, const MatrixValues& values) {
  if ((scene_.fluid && !values.fluid) || (scene_.wall && !values.wall)) return;
  if (unit_.products >= enough) return;
  const Communicator& processes = scene_.processes();
  // The first one tells what others would take. All processes have to decide alike.
  if (unit_.products > 0 && unit_.spent + unit_.spent / unit_.products > largest_share * processes.smallest(elapsed))
    return;
  const auto begin = Clock::now();
  CoupledProduct<n> product(scene_);
  if (unit_.products == 0) unit_.entries = product.entries();
  processes.wait();
  const auto start = Clock::now();
  product.multiply(values);
  const double seconds = processes.largest(seconds_since(start));
  unit_.seconds = unit_.products == 0 ? seconds : std::min(unit_.seconds, seconds);
  unit_.spent += processes.largest(seconds_since(begin));
  ++unit_.products;
}

#define FSI_INSTANTIATE(n)          \
  template class CoupledProduct<n>; \
  template class WorkUnitMeter<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
