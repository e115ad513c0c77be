#pragma once

#include <cmath>

#include "monolithic/coupled_solvers/block/coupled_system.hpp"

namespace fsi::test {

/// A vector for the system's columns, no two entries alike.
inline CoupledVector waves(const CoupledMatrix<3>& k) {
  CoupledVector x = k.zero_vector();
  int i = 0;
  for (auto* part : {&x.mesh, &x.fluid, &x.wall})
    for (double& value : *part) value = std::sin(1.0 + 0.7 * i++);
  return x;
}

}  // namespace fsi::test
