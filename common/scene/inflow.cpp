#include "scene/inflow.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "case/openings.hpp"
#include "fem/elements.hpp"
#include "fluid/inflow_profile.hpp"
#include "fluid/womersley_inflow.hpp"

namespace fsi {

namespace {

/// The same table as a periodic flow: without the end of the period, which is its beginning.
PeriodicFlow periodic_flow(const PressureTable& table) {
  PeriodicFlow flow{table.period, table.points};
  while (flow.points.size() > 1 && flow.points.back().first >= table.period) flow.points.pop_back();
  return flow;
}

}  // namespace

template <class Element>
MadeInflow<Element::components> make_inflow(const Case& setup, const MeshOf<Element>& mesh, const PartOf<Element>& part,
                                            InflowNodes where, const PartRestriction* here) {
  constexpr int n = Element::components;
  const OpeningData opening = openings_of(setup).at(where.opening);
  const InflowOpening<Element> place{opening.surface, part.nodes,
                                     in_part<Element>(part, group_facets(mesh, opening.surface)),
                                     std::move(where.sticking), setup.path.string()};
  const std::size_t size =
      VectorLayout<n>::size(here ? static_cast<int>(here->whole_nodes().size()) : part.node_count());
  if (here) where.nodes = here->nodes(where.nodes);
  const FlowRateData& rate = opening.flow_rate.value();
  if (rate.profile == InflowProfile::womersley) {
    auto of_opening =
        womersley_inflow<Element>(place, periodic_flow(rate.table), setup.fluid->density, setup.fluid->viscosity);
    if (here)
      of_opening.keep([&](std::size_t entry) {
        const int node = here->local(static_cast<int>(entry) / n);
        return node < 0 ? -1 : static_cast<std::ptrdiff_t>(VectorLayout<n>::vector(node));
      });
    const auto womersley = std::make_shared<const WomersleyInflow>(std::move(of_opening));
    return {{where.opening, std::move(where.nodes), size,
             [womersley](double time, double flow, std::vector<double>& velocity) {
               womersley->set(time, flow, velocity);
             }},
            womersley->instead(),
            fmt::format("the flow of {} in Womersley's profile: its mean and {} {}", opening.surface,
                        womersley->modes(), womersley->modes() == 1 ? "harmonic" : "harmonics")};
  }
  UnitInflow unit =
      rate.profile == InflowProfile::plug ? plug_inflow<Element>(place) : parabolic_inflow<Element>(place);
  if (here) unit.velocity = here->field(unit.velocity, n);
  return {{where.opening, std::move(where.nodes), size,
           [profile = std::move(unit.velocity)](double, double flow, std::vector<double>& velocity) {
             for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] = flow * profile[i];
           }},
          std::move(unit.instead)};
}

#define FSI_INSTANTIATE(Element)                                 \
  template MadeInflow<Element::components> make_inflow<Element>( \
      const Case&, const MeshOf<Element>&, const PartOf<Element>&, InflowNodes, const PartRestriction*);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
