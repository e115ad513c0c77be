#pragma once

#include <vector>

#include "algebra/block_products.hpp"
#include "system/linear_solver.hpp"

namespace fsi {

/// Products with a Jacobian in the unknowns of its numbering, from its block matrices.
template <class Element>
class JacobianProduct {
 public:
  static constexpr int n = Element::components;

  explicit JacobianProduct(const JacobianBlocks<Element>& blocks) : blocks_(blocks) {
    flow_.resize(blocks.numbering.flow.size());
    mesh_.resize(blocks.numbering.mesh.size());
    wall_.resize(blocks.numbering.wall.size());
    flow_rows_ = flow_;
    mesh_rows_ = mesh_;
    wall_rows_ = wall_;
  }

  /// y = J x, y resized.
  void multiply(const std::vector<double>& x, std::vector<double>& y) {
    const Numbering& numbering = blocks_.numbering;
    y.assign(static_cast<std::size_t>(numbering.size), 0.0);
    if (blocks_.shape_derivatives || blocks_.mesh_laplacian) values(numbering.mesh, x, mesh_);
    if (blocks_.flow) {
      values(numbering.flow, x, flow_);
      fsi::multiply(*blocks_.flow, flow_, flow_rows_);
      if (blocks_.shape_derivatives) multiply_add(*blocks_.shape_derivatives, mesh_, flow_rows_);
      add_to_system(numbering.flow_rows, flow_rows_, y);
    }
    if (blocks_.mesh_laplacian) {
      multiply_components<n>(*blocks_.mesh_laplacian, mesh_, mesh_rows_);
      add_to_system(numbering.mesh_rows, mesh_rows_, y);
    }
    if (blocks_.wall) {
      values(numbering.wall, x, wall_);
      fsi::multiply(*blocks_.wall, wall_, wall_rows_);
      add_to_system(numbering.wall_rows, wall_rows_, y);
    }
  }

 private:
  static void values(const UnknownMap& map, const std::vector<double>& x, std::vector<double>& field) {
#pragma omp parallel for schedule(static) if (map.size() > 16384)
    for (std::size_t i = 0; i < map.size(); ++i) field[i] = map[i].index < 0 ? 0 : map[i].factor * x[map[i].index];
  }

  JacobianBlocks<Element> blocks_;
  std::vector<double> flow_, mesh_, wall_, flow_rows_, mesh_rows_, wall_rows_;
};

}  // namespace fsi
