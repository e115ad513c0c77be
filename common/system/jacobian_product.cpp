#include "system/jacobian_product.hpp"

#include "algebra/block_products.hpp"
#include "fem/dimensions.hpp"

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
  if (blocks_.shape_derivatives || blocks_.mesh_laplacian || blocks_.mesh_tangent) values(numbering.mesh, x, mesh_);
  if (blocks_.fluid) {
    values(numbering.fluid, x, fluid_);
    fsi::multiply(*blocks_.fluid, fluid_, fluid_rows_);
    if (blocks_.shape_derivatives) multiply_add(*blocks_.shape_derivatives, mesh_, fluid_rows_);
    add_to_system(numbering.fluid_rows, fluid_rows_, y);
  }
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
  if (blocks_.wall) {
    values(numbering.wall, x, wall_);
    fsi::multiply(*blocks_.wall, wall_, wall_rows_);
    add_to_system(numbering.wall_rows, wall_rows_, y);
  }
}

template <int n>
void JacobianProduct<n>::values(const UnknownMap& map, const std::vector<double>& x, std::vector<double>& field) {
#pragma omp parallel for schedule(static) if (map.size() > 16384)
  for (std::size_t i = 0; i < map.size(); ++i) field[i] = map[i].index < 0 ? 0 : map[i].factor * x[map[i].index];
}

#define FSI_INSTANTIATE(n) template class JacobianProduct<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
