#include "scene/inflow.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "case/openings.hpp"
#include "fem/dimensions.hpp"
#include "fem/elements.hpp"
#include "fluid/inflow_profile.hpp"

namespace fsi {

namespace {

/// The same table as a periodic flow: without the end of the period, which is its beginning. Before its first row a table
/// has that row's value.
PeriodicFlow periodic_flow(const PressureTable& table) {
  PeriodicFlow flow{table.period, table.points};
  if (const auto [time, value] = flow.points.front(); time > 0) flow.points.insert(flow.points.begin(), {0, value});
  while (flow.points.size() > 1 && flow.points.back().first >= table.period) flow.points.pop_back();
  return flow;
}

}  // namespace

template <class Element>
Inflow make_inflow(const Case& setup, const MeshOf<Element>& mesh, const PartOf<Element>& part, InflowNodes where) {
  const OpeningData opening = openings_of(setup).at(where.opening);
  const InflowOpening<Element> place{opening.surface, part.nodes,
                                     in_part<Element>(part, group_facets(mesh, opening.surface)),
                                     std::move(where.sticking), setup.path.string()};
  Inflow inflow{where.opening, std::move(where.nodes), {}, nullptr, {}};
  const FlowRateData& rate = opening.flow_rate.value();
  if (rate.profile == InflowProfile::womersley) {
    inflow.womersley = std::make_shared<WomersleyInflow>(
        womersley_inflow<Element>(place, periodic_flow(rate.table), setup.fluid->density, setup.fluid->viscosity));
    const int modes = inflow.womersley->modes();
    inflow.instead = inflow.womersley->instead();
    inflow.remark = fmt::format("the flow of {} in Womersley's profile: its mean and {} {}", opening.surface, modes,
                                modes == 1 ? "harmonic" : "harmonics");
    return inflow;
  }
  UnitInflow unit = rate.profile == InflowProfile::plug          ? plug_inflow<Element>(place)
                    : rate.profile == InflowProfile::biparabolic ? biparabolic_inflow<Element>(place)
                                                                 : parabolic_inflow<Element>(place);
  inflow.profile = std::move(unit.velocity);
  inflow.instead = std::move(unit.instead);
  return inflow;
}

template <int n>
void restrict_to(const PartRestriction& here, Inflow& inflow) {
  inflow.nodes = here.nodes(inflow.nodes);
  inflow.profile = here.field(inflow.profile, n);
  if (inflow.womersley)
    inflow.womersley->keep([&](std::size_t entry) {
      const int node = here.local(static_cast<int>(entry) / n);
      return node < 0 ? -1 : static_cast<std::ptrdiff_t>(VectorLayout<n>::vector(node));
    });
}

template <int n>
PrescribedInflow<n> prescribed(Inflow inflow, int nodes) {
  typename PrescribedInflow<n>::Profile profile;
  if (inflow.womersley)
    profile = [womersley = std::move(inflow.womersley)](double time, double flow, std::vector<double>& velocity) {
      womersley->set(time, flow, velocity);
    };
  else
    profile = [unit = std::move(inflow.profile)](double, double flow, std::vector<double>& velocity) {
      for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] = flow * unit[i];
    };
  return {inflow.opening, std::move(inflow.nodes), VectorLayout<n>::size(nodes), std::move(profile)};
}

#define FSI_INSTANTIATE(Element) \
  template Inflow make_inflow<Element>(const Case&, const MeshOf<Element>&, const PartOf<Element>&, InflowNodes);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE
#define FSI_INSTANTIATE(n)                                       \
  template void restrict_to<n>(const PartRestriction&, Inflow&); \
  template PrescribedInflow<n> prescribed<n>(Inflow, int);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
