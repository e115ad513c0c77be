#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "algebra/vector_operations.hpp"
#include "fem/nodal_layout.hpp"

namespace fsi {

/// A vector of the coupled system, the paper's x = (d_m, (u, p_f), (d_s, p_s)) with node-wise blocks: with n components
/// of a vector, in the vector layout per fluid node, in the mixed layout per fluid node and per wall node.
struct CoupledVector {
  std::vector<double> mesh, fluid, wall;

  std::size_t size() const { return mesh.size() + fluid.size() + wall.size(); }
  void set_zero() {
    for (auto* part : {&mesh, &fluid, &wall}) std::fill(part->begin(), part->end(), 0.0);
  }
};

/// y += factor * x
inline void axpy(double factor, const CoupledVector& x, CoupledVector& y) {
  axpy(factor, x.mesh, y.mesh);
  axpy(factor, x.fluid, y.fluid);
  axpy(factor, x.wall, y.wall);
}

inline double dot(const CoupledVector& x, const CoupledVector& y) {
  return dot(x.mesh, y.mesh) + dot(x.fluid, y.fluid) + dot(x.wall, y.wall);
}
inline double norm(const CoupledVector& x) {
  return std::sqrt(dot(x, x));
}

/// The parts one after the other, as Krylov methods take a vector; and back.
inline void flatten(const CoupledVector& x, std::vector<double>& flat) {
  flat.resize(x.size());
  auto to = flat.begin();
  for (const auto* part : {&x.mesh, &x.fluid, &x.wall}) to = std::copy(part->begin(), part->end(), to);
}
/// \param x  its parts have their sizes
inline void unflatten(const std::vector<double>& flat, CoupledVector& x) {
  auto from = flat.begin();
  for (auto* part : {&x.mesh, &x.fluid, &x.wall}) {
    std::copy(from, from + static_cast<std::ptrdiff_t>(part->size()), part->begin());
    from += static_cast<std::ptrdiff_t>(part->size());
  }
}

}  // namespace fsi
