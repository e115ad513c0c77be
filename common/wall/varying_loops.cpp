#include "fem/elements.hpp"
#include "wall/layer_loops_of.hpp"
#include "wall/unloaded_shape.hpp"

namespace fsi {

template <class Element, class M>
AssemblyResult UnloadedLoops<Element, M>::assemble(const Hyperelastic<M>& form, const WallLayer<Element>& layer,
                                                   const WallInput& in, std::vector<double>& residual,
                                                   WallMatrix<Element::components>* jacobian) {
  return detail::assemble_layer<Element, false>(UnloadedShape<M>{form}, layer, in, residual, jacobian);
}

#define FSI_INSTANTIATE(Element)                   \
  template struct LayerLoops<Element, VaryingLaw>; \
  template struct UnloadedLoops<Element, VaryingLaw>;
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
