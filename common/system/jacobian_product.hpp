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

  explicit JacobianProduct(const JacobianBlocks<Element>& blocks);

  /// y = J x, y resized.
  void multiply(const std::vector<double>& x, std::vector<double>& y);

 private:
  static void values(const UnknownMap& map, const std::vector<double>& x, std::vector<double>& field);

  JacobianBlocks<Element> blocks_;
  std::vector<double> fluid_, mesh_, wall_, fluid_rows_, mesh_rows_, wall_rows_;
};

}  // namespace fsi
