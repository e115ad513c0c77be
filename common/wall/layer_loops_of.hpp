#pragma once

// What LayerLoops do; for the files that compile them.

#include "wall/layer_loops.hpp"
#include "wall/wall_energy.hpp"

namespace fsi {

template <class Element, class M>
AssemblyResult LayerLoops<Element, M>::assemble(const Hyperelastic<M>& form, const WallLayer<Element>& layer,
                                                const WallInput& in, std::vector<double>& residual,
                                                WallMatrix<Element::components>* jacobian) {
  return detail::assemble_layer(form, layer, in, residual, jacobian);
}

template <class Element, class M>
WallEnergy LayerLoops<Element, M>::energy(const Hyperelastic<M>& form, const WallLayer<Element>& layer,
                                          const double* wall, const double* velocity, const double* balance,
                                          const double* prestress) {
  return detail::layer_energy(form, layer, wall, velocity, balance, prestress);
}

template <class Element, class M>
WallWork LayerLoops<Element, M>::work(const Hyperelastic<M>& form, const WallLayer<Element>& layer,
                                      const WallStep& step) {
  return detail::layer_work(form, layer, step);
}

}  // namespace fsi
