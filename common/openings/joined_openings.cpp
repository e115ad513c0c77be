#include "openings/joined_openings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "fem/dimensions.hpp"

namespace fsi {

namespace {

constexpr double far = 2;        // factor of a valve's conductance: a kept Jacobian bears smaller ones
constexpr int many_changes = 2;  // of a valve in one stage: in a step that goes well it opens or closes once

NetworkMoment balance_at(double factor, double time) {
  return {1 / factor, time};
}

}  // namespace

template <int n>
JoinedOpenings<n>::JoinedOpenings(std::vector<Opening> openings, std::shared_ptr<const Network> network,
                                  std::size_t place)
    : openings_(std::move(openings)), network_(std::move(network)), place_(place) {
  courses_.resize(network_->elements().size());
}

template <int n>
std::vector<double> JoinedOpenings<n>::inflows(const FluidInput& in) const {
  std::vector<double> flows;
  for (const Opening& opening : openings_) flows.push_back(opening.surface->relative_outflow(in));
  return flows;
}

template <int n>
NetworkState JoinedOpenings<n>::at_balance(const FluidInput& in, double time,
                                           const std::vector<double>& reference) const {
  return network_->solve(balance_at(in.fluid_factor, time), reference.data() + place_, inflows(in));
}

template <int n>
void JoinedOpenings<n>::start_rates(const std::vector<double>& kept, const std::vector<double>& mesh,
                                    const std::vector<double>& flow, std::vector<double>& rates) const {
  if (empty()) return;
  const std::vector<double> own = network_->rates(with_flows_of_level(0, kept, mesh, flow));
  std::copy(own.begin(), own.end(), rates.begin() + static_cast<std::ptrdiff_t>(place_));
}

template <int n>
void JoinedOpenings<n>::add_pressures(const FluidInput& in, double time, const std::vector<double>& reference,
                                      std::vector<double>& pressures) const {
  if (empty()) return;
  const NetworkState state = at_balance(in, time, reference);
  watch_valves(in, time, reference, state);
  for (std::size_t i = 0; i < openings_.size(); ++i)
    pressures[openings_[i].number] += state.settled ? state.pressures[i] : std::numeric_limits<double>::quiet_NaN();
}

template <int n>
void JoinedOpenings<n>::subtract_still_pressures(double factor, double time, const std::vector<double>& reference,
                                                 std::vector<double>& pressures) const {
  if (empty()) return;
  const std::vector<double> none(openings_.size(), 0.0);
  const NetworkState state = network_->solve(balance_at(factor, time), reference.data() + place_, none);
  for (std::size_t i = 0; i < openings_.size(); ++i) pressures[openings_[i].number] -= state.pressures[i];
}

template <int n>
void JoinedOpenings<n>::settle(const FluidInput& in, double time, const std::vector<double>& reference,
                               std::vector<double>& kept) const {
  if (empty()) return;
  const NetworkState state = at_balance(in, time, reference);
  const std::vector<double> own = network_->kept(balance_at(in.fluid_factor, time), reference.data() + place_, state);
  std::copy(own.begin(), own.end(), kept.begin() + static_cast<std::ptrdiff_t>(place_));
  std::fill(courses_.begin(), courses_.end(), Course());
  unsettled_.clear();
}

template <int n>
std::vector<double> JoinedOpenings<n>::slopes(const FluidInput& in, double time,
                                              const std::vector<double>& reference) const {
  const NetworkMoment at = balance_at(in.fluid_factor, time);
  const NetworkState state = at_balance(in, time, reference);
  of_slopes_ = conductances_ = network_->conductances(at, reference.data() + place_, state);
  return network_->slopes(at, reference.data() + place_, state);
}

template <int n>
NetworkState JoinedOpenings<n>::with_flows_of_level(double time, const std::vector<double>& kept,
                                                    const std::vector<double>& mesh,
                                                    const std::vector<double>& flow) const {
  std::vector<double> flows, pressures;
  for (const Opening& opening : openings_) {
    flows.push_back(opening.surface->outflow(mesh, flow));
    pressures.push_back(opening.surface->mean_pressure(mesh, flow));
  }
  return network_->at_level(time, kept.data() + place_, flows, pressures);
}

template <int n>
NetworkState JoinedOpenings<n>::at_level(double time, const std::vector<double>& kept, const std::vector<double>& mesh,
                                         const std::vector<double>& flow) const {
  NetworkState state = with_flows_of_level(time, kept, mesh, flow);
  for (std::size_t i = 0; i < openings_.size(); ++i)
    state.pressures[i] = openings_[i].surface->mean_pressure(mesh, flow);
  return state;
}

template <int n>
bool JoinedOpenings<n>::outdated() const {
  if (of_slopes_.size() != conductances_.size()) return false;
  for (std::size_t e = 0; e < conductances_.size(); ++e)
    if (conductances_[e] > far * of_slopes_[e] || of_slopes_[e] > far * conductances_[e]) return true;
  return false;
}

template <int n>
void JoinedOpenings<n>::watch_valves(const FluidInput& in, double time, const std::vector<double>& reference,
                                     const NetworkState& state) const {
  if (state.settled)
    conductances_ = network_->conductances(balance_at(in.fluid_factor, time), reference.data() + place_, state);
  const auto& elements = network_->elements();
  if (!state.settled) {
    unsettled_ = elements[state.unsettled].name;
    return;
  }
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (!elements[e].law->switches()) continue;
    Course& course = courses_[e];
    const bool open = state.flows[e] > 0;
    if (course.seen && open != course.open) ++course.changes;
    course.seen = true;
    course.open = open;
  }
}

template <int n>
std::string JoinedOpenings<n>::complaint() const {
  if (!unsettled_.empty()) return fmt::format("network.element.{} finds neither open nor closed", unsettled_);
  const auto most = std::max_element(courses_.begin(), courses_.end(),
                                     [](const Course& a, const Course& b) { return a.changes < b.changes; });
  if (most == courses_.end() || most->changes < many_changes) return "";
  return fmt::format("network.element.{} opened and closed {} times in its iterations: the valve chatters",
                     network_->elements()[static_cast<std::size_t>(most - courses_.begin())].name, most->changes);
}

#define FSI_INSTANTIATE(n) template class JoinedOpenings<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
