#pragma once

#include <vector>

#include "fem/assembly_result.hpp"
#include "fem/element_packs.hpp"
#include "fluid/ale_fluid.hpp"
#include "fluid/fluid_input.hpp"

namespace fsi {

/// The element loops of a fluid whose viscosity follows a law, see assemble_fluid() and fluid_work(). They are compiled
/// in a file of their own, so that what a compiler makes of those of a constant viscosity does not depend on them.
template <class Element>
struct ShearDependentLoops {
  static AssemblyResult assemble(const ShearDependentFluid& form, const ElementPacks<Element>& packs,
                                 const FluidInput& in, std::vector<double>& residual, FluidDerivatives derivatives,
                                 FluidJacobian<Element::components>* jacobian);
  static FluidWork work(const ShearDependentFluid& form, const ElementPacks<Element>& packs, const FluidStep& step);
};

}  // namespace fsi
