#include "fluid/fluid_problem.hpp"

#include <cassert>
#include <utility>

#include "fem/elements.hpp"
#include "fluid/fluid_assembly.hpp"
#include "fluid/fluid_energy.hpp"

namespace fsi {

template <class Element>
FluidProblem<Element>::FluidProblem(Part part, const AleFluid& form, std::vector<OpenBoundary<Element>> open)
    : part_(std::move(part)),
      form_(form),
      space_(part_),
      packs_(part_.nodes, part_.cells, space_.all_cells(), *space_.graph()),
      open_(std::move(open)) {}

template <class Element>
const OpenBoundary<Element>* FluidProblem<Element>::open_boundary(const std::string& name) const {
  for (const auto& boundary : open_)
    if (boundary.name() == name) return &boundary;
  return nullptr;
}

template <class Element>
AssemblyResult FluidProblem<Element>::assemble(const FluidInput& in, const std::vector<double>& pressures,
                                               std::vector<double>& residual, FluidDerivatives derivatives) {
  assert(pressures.size() <= open_.size());
  jacobian(derivatives);  // storage
  residual.assign(space_.mixed_size(), 0.0);
  const auto result = assemble_fluid(form_, packs_, in, residual, derivatives, &jacobian_);
  for (std::size_t i = 0; i < pressures.size(); ++i) open_[i].add_pressure(pressures[i], residual);
  return result;
}

template <class Element>
FluidJacobian<Element>& FluidProblem<Element>::jacobian(FluidDerivatives derivatives) {
  if (derivatives != FluidDerivatives::none && jacobian_.fluid.values.empty())
    jacobian_.fluid = decltype(jacobian_.fluid)(graph());
  if (derivatives == FluidDerivatives::fluid_and_domain && jacobian_.shape_derivatives.values.empty())
    jacobian_.shape_derivatives = decltype(jacobian_.shape_derivatives)(graph());
  return jacobian_;
}

template <class Element>
FluidEnergy FluidProblem<Element>::energy(const FluidInput& in) const {
  return fluid_energy(form_, packs_, in);
}

#define FSI_INSTANTIATE(Element) template class FluidProblem<Element>;
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
