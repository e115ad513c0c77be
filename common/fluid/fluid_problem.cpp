#include "fluid/fluid_problem.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "fem/elements.hpp"
#include "fluid/fluid_assembly.hpp"
#include "fluid/fluid_energy.hpp"

namespace fsi {

template <class Element>
FluidProblem<Element>::FluidProblem(Part part, const AleFluid& form, std::vector<OpenBoundary<n>> open,
                                    VanishingComponents<n> mirrored)
    : part_(std::move(part)),
      form_(form),
      space_(function_space<Element>(part_)),
      packs_(part_.nodes, part_.cells, all_cells(part_), *space_.graph(), part_.counted),
      mirrored_(std::move(mirrored)),
      projection_(mirrored_),
      open_(std::move(open)) {
  for (int a = 0; a < part_.node_count(); ++a)
    if (part_.owns(a)) volume_ += space_.volumes()[a];
  volume_ = part_.processes().sum(volume_);
}

template <class Element>
AssemblyResult FluidProblem<Element>::assemble(const FluidInput& in, const std::vector<double>& pressures,
                                               std::vector<double>& residual, FluidJacobian<n>* jacobian) {
  assert(pressures.size() <= open_.size());
  residual.assign(space_.mixed_size(), 0.0);
  const auto derivatives = jacobian ? jacobian->derivatives() : FluidDerivatives::none;
  const auto result = assemble_fluid(form_, packs_, projected(in), residual, derivatives, jacobian);
  add_openings(in, pressures, residual, jacobian);
  return result;
}

template <class Element>
void FluidProblem<Element>::add_openings(const FluidInput& in, const std::vector<double>& pressures,
                                         std::vector<double>& residual, FluidJacobian<n>* jacobian) {
  const auto derivatives = jacobian ? jacobian->derivatives() : FluidDerivatives::none;
  for (std::size_t i = 0; i < open_.size(); ++i)
    open_[i].add_pressure(i < pressures.size() ? pressures[i] : 0, in.mesh, residual,
                          derivatives == FluidDerivatives::fluid_and_domain ? &jacobian->shape_derivatives : nullptr);
  for (const auto& [open, facets] : backflow_)
    facets.add(form_.density, in.fluid, residual.data(), derivatives == FluidDerivatives::none ? nullptr : jacobian);
  for (const auto& [open, beta] : moving_backflow_)
    open_[open].moving()->add_backflow(form_.density, beta, in, residual.data(), jacobian, derivatives);
}

template <class Element>
void FluidProblem<Element>::stabilise_backflow(std::size_t open, double coefficient) {
  backflow_.erase(open);
  moving_backflow_.erase(open);
  if (coefficient != 0 && open_.at(open).moving())
    moving_backflow_.emplace(open, coefficient);
  else if (coefficient != 0)
    backflow_.emplace(open, BackflowFacets<Element>(coefficient, part_, open_.at(open).facets(), *space_.graph()));
}

template <class Element>
double FluidProblem<Element>::kinetic_energy(const std::vector<double>& mesh, const std::vector<double>& flow) const {
  // By the loop of work(): a restarted run gets the energy to the last bit as one that was not interrupted.
  FluidStep level;
  FluidInput& in = level.balance;
  in.step = 1;
  in.mesh = in.mesh_reference = level.mesh_start = level.mesh_end = mesh.empty() ? nullptr : mesh.data();
  in.fluid = in.fluid_reference = level.fluid_start = level.fluid_end = flow.data();
  return fluid_work(form_, packs_, level).kinetic_end;
}

template <class Element>
FluidWork FluidProblem<Element>::work(const FluidStep& step) const {
  FluidWork work = fluid_work(form_, packs_, step);
  for (const auto& [open, facets] : backflow_)
    work.backflow += step.duration * facets.power(form_.density, step.balance.fluid);
  for (const auto& [open, beta] : moving_backflow_)
    work.backflow += step.duration * open_[open].moving()->backflow_power(form_.density, beta, step.balance);
  return work;
}

template <class Element>
FluidInput FluidProblem<Element>::projected(const FluidInput& in) {
  FluidInput with = in;
  if constexpr (Element::stabilised)
    if (form_.wave_speed > 0 && !in.projected_gradient)
      with.projected_gradient = projection_.of(in, packs_, part_).data();
  return with;
}

template <class Element>
double FluidProblem<Element>::power_at(const std::vector<int>& nodes, const FluidInput& in,
                                       const std::vector<double>& pressures) {
  if (!packs_at_) {
    std::vector<char> chosen(static_cast<std::size_t>(part_.node_count()), 0);
    for (const int node : nodes) chosen[node] = 1;
    std::vector<int> cells;
    for (std::size_t c = 0; c < part_.cells.size(); ++c)
      if (std::any_of(part_.cells[c].begin(), part_.cells[c].end(), [&](int node) { return chosen[node] != 0; }))
        cells.push_back(static_cast<int>(c));
    packs_at_.emplace(part_.nodes, part_.cells, cells, *space_.graph());
  }
  rows_.assign(space_.mixed_size(), 0.0);
  assemble_fluid(form_, *packs_at_, projected(in), rows_);
  add_openings(in, pressures, rows_, nullptr);
  double power = 0;
  for (const int node : nodes)
    if (part_.owns(node))
      for (int k = 0; k < n; ++k) {
        const std::size_t at = MixedLayout<n>::vector(node, k);
        power += rows_[at] * in.fluid[at];
      }
  return power;
}

template <class Element>
std::vector<int> FluidProblem<Element>::cell_vertices() const {
  return vertices_of_cells(part_);
}

#define FSI_INSTANTIATE(Element) template class FluidProblem<Element>;
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
