#include <tuple>
#include <type_traits>
#include <variant>

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

namespace detail {

/// Compiles them for every law with loops of its own; those of constants that vary are in varying_loops.cpp.
template <class Element, class... M>
auto unloaded_loops(const std::variant<M...>*) {
  return std::tuple_cat([] {
    if constexpr (std::is_same_v<M, VaryingLaw>)
      return std::tuple<>();
    else
      return std::tuple(&UnloadedLoops<Element, M>::assemble);
  }()...);
}

#define FSI_INSTANTIATE(Element) template auto unloaded_loops<Element>(const ElementLaw*);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace detail

}  // namespace fsi
