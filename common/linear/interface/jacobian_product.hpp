#pragma once

#include <vector>

#include "algebra/block_products.hpp"
#include "linear/interface/linear_solver.hpp"

namespace fsi {

/// Products with a Jacobian in the unknowns of its numbering, from its block matrices.
template <int n>
class JacobianProduct {
 public:
  explicit JacobianProduct(const JacobianBlocks<n>& blocks);

  /// y = J x, y resized to the equations here. \param x  with its ghosts (Numbering::update_ghosts)
  void multiply(const std::vector<double>& x, std::vector<double>& y);
  /// The same of the mesh's own equations; y is zero in all others.
  void multiply_mesh_rows(const std::vector<double>& x, std::vector<double>& y);

 private:
  bool has_mesh() const { return blocks_.shape_derivatives || blocks_.mesh_laplacian || blocks_.mesh_tangent; }
  /// y += what mesh_ contributes to the mesh's equations.
  void add_mesh_rows(std::vector<double>& y);
  static void values(const UnknownMap& map, const std::vector<double>& x, std::vector<double>& field);

  JacobianBlocks<n> blocks_;
  std::vector<double> fluid_, mesh_, wall_, fluid_rows_, mesh_rows_, wall_rows_;
};

/// terms += |J| x, |J| having the absolute values of J's entries: the size of the terms that cancel in J x. Frames of
/// the mesh motion's Laplacian are not applied.
/// \param x      not negative, with its ghosts
/// \param terms  of this process's equations
template <int n>
void add_absolute_products(const JacobianBlocks<n>& j, const std::vector<double>& x, std::vector<double>& terms);

}  // namespace fsi
