#include "linear/interface/jacobian_product.hpp"

#include <cmath>
#include <type_traits>

#include "algebra/block_products.hpp"
#include "fem/dimensions.hpp"
#include "host/parallel_for.hpp"

namespace fsi {

template <int n>
JacobianProduct<n>::JacobianProduct(const JacobianBlocks<n>& blocks) : blocks_(blocks) {
  fluid_.resize(blocks.numbering.fluid.size());
  mesh_.resize(blocks.numbering.mesh.size());
  wall_.resize(blocks.numbering.wall.size());
  fluid_rows_ = fluid_;
  mesh_rows_ = mesh_;
  wall_rows_ = wall_;
}

template <int n>
void JacobianProduct<n>::multiply(const std::vector<double>& x, std::vector<double>& y) {
  const Numbering& numbering = blocks_.numbering;
  y.assign(static_cast<std::size_t>(numbering.size), 0.0);
  if (has_mesh()) values(numbering.mesh, x, mesh_);
  if (blocks_.fluid) {
    values(numbering.fluid, x, fluid_);
    fsi::multiply(*blocks_.fluid, fluid_, fluid_rows_);
    if (blocks_.shape_derivatives) multiply_add(*blocks_.shape_derivatives, mesh_, fluid_rows_);
    add_to_system(numbering.fluid_rows, fluid_rows_, y);
  }
  add_mesh_rows(y);
  if (blocks_.wall) {
    values(numbering.wall, x, wall_);
    fsi::multiply(*blocks_.wall, wall_, wall_rows_);
    add_to_system(numbering.wall_rows, wall_rows_, y);
  }
}

template <int n>
void JacobianProduct<n>::multiply_mesh_rows(const std::vector<double>& x, std::vector<double>& y) {
  y.assign(static_cast<std::size_t>(blocks_.numbering.size), 0.0);
  if (!has_mesh()) return;
  values(blocks_.numbering.mesh, x, mesh_);
  add_mesh_rows(y);
}

template <int n>
void JacobianProduct<n>::add_mesh_rows(std::vector<double>& y) {
  const Numbering& numbering = blocks_.numbering;
  if (blocks_.mesh_laplacian) {
    if (blocks_.fluid_frames) blocks_.fluid_frames->template to_space<VectorLayout<n>>(mesh_);
    multiply_components<n>(*blocks_.mesh_laplacian, mesh_, mesh_rows_);
    if (blocks_.fluid_frames) blocks_.fluid_frames->template to_frames<VectorLayout<n>>(mesh_rows_);
    add_to_system(numbering.mesh_rows, mesh_rows_, y);
  }
  if (blocks_.mesh_tangent) {
    fsi::multiply(*blocks_.mesh_tangent, mesh_, mesh_rows_);
    add_to_system(numbering.mesh_rows, mesh_rows_, y);
  }
}

template <int n>
void JacobianProduct<n>::values(const UnknownMap& map, const std::vector<double>& x, std::vector<double>& field) {
  parallel_for(map.size(), map.size() > 16384,
               [&](std::size_t i) { field[i] = map[i].index < 0 ? 0 : map[i].factor * x[map[i].index]; });
}

template <int n>
void add_absolute_products(const JacobianBlocks<n>& j, const std::vector<double>& x, std::vector<double>& terms) {
  const Numbering& numbering = j.numbering;
  const auto add = [&](const auto& matrix, const UnknownMap& rows, const UnknownMap& columns, bool by_component) {
    constexpr int r = std::decay_t<decltype(matrix)>::rows, c = std::decay_t<decltype(matrix)>::columns;
    const auto& graph = *matrix.graph;
    const int rows_per_node = by_component ? c : r;
    for (int a = 0; a < graph.rows(); ++a)
      for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at)
        for (int i = 0; i < rows_per_node; ++i) {
          const Unknown& row = rows[static_cast<std::size_t>(a) * rows_per_node + i];
          if (row.index < 0) continue;
          double sum = 0;
          for (int k = by_component ? i : 0; k < (by_component ? i + 1 : c); ++k) {
            const Unknown& column = columns[static_cast<std::size_t>(graph.columns[at]) * c + k];
            const double value = matrix.block(at)[by_component ? k : i * c + k];
            if (column.index >= 0) sum += std::abs(value * column.factor) * x[column.index];
          }
          terms[row.index] += std::abs(row.factor) * sum;
        }
  };
  if (j.wall) add(*j.wall, numbering.wall_rows, numbering.wall, false);
  if (j.fluid) add(*j.fluid, numbering.fluid_rows, numbering.fluid, false);
  if (j.shape_derivatives) add(*j.shape_derivatives, numbering.fluid_rows, numbering.mesh, false);
  if (j.mesh_tangent) add(*j.mesh_tangent, numbering.mesh_rows, numbering.mesh, false);
  if (j.mesh_laplacian) add(*j.mesh_laplacian, numbering.mesh_rows, numbering.mesh, true);
}

#define FSI_INSTANTIATE(n)           \
  template class JacobianProduct<n>; \
  template void add_absolute_products<n>(const JacobianBlocks<n>&, const std::vector<double>&, std::vector<double>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
