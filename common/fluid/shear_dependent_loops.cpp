#include "fluid/shear_dependent_loops.hpp"

#include "fem/elements.hpp"
#include "fluid/fluid_assembly.hpp"
#include "fluid/fluid_energy.hpp"

namespace fsi {

template <class Element>
AssemblyResult ShearDependentLoops<Element>::assemble(const ShearDependentFluid& form,
                                                      const ElementPacks<Element>& packs, const FluidInput& in,
                                                      std::vector<double>& residual, FluidDerivatives derivatives,
                                                      FluidJacobian<Element::components>* jacobian) {
  return detail::assemble_form(form, packs, in, residual, derivatives, jacobian);
}

template <class Element>
FluidWork ShearDependentLoops<Element>::work(const ShearDependentFluid& form, const ElementPacks<Element>& packs,
                                             const FluidStep& step) {
  return detail::work_of_form(form, packs, step);
}

#define FSI_INSTANTIATE(Element) template struct ShearDependentLoops<Element>;
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
