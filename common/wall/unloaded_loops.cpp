#include "fem/elements.hpp"
#include "wall/unloaded_shape.hpp"
#include "wall/wall_assembly.hpp"

namespace fsi {

template <class Element, class M>
AssemblyResult UnloadedLoops<Element, M>::assemble(const Hyperelastic<M>& form, const WallLayer<Element>& layer,
                                                   const WallInput& in, std::vector<double>& residual,
                                                   WallMatrix<Element::components>* jacobian) {
  return detail::assemble_layer<Element, false>(UnloadedShape<M>{form}, layer, in, residual, jacobian);
}

#define FSI_INSTANTIATE(Element)                           \
  template struct UnloadedLoops<Element, NeoHookean>;      \
  template struct UnloadedLoops<Element, MooneyRivlin>;    \
  template struct UnloadedLoops<Element, Artery>;          \
  template struct UnloadedLoops<Element, DispersedArtery>; \
  template struct UnloadedLoops<Element, CompressibleLaw>;
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
