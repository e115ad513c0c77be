#include "scene/moving_openings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/error.hpp"
#include "case/openings.hpp"
#include "fem/dimensions.hpp"
#include "fem/elements.hpp"
#include "fem/held_components.hpp"

namespace fsi {

namespace {

/// A unit vector without its share along another one; nothing is left of one that is parallel to it to 1e-4.
template <int n>
std::optional<Direction<n>> across(Direction<n> v, const Direction<n>& other) {
  const double along = detail::dot<n>(v, other);
  for (int k = 0; k < n; ++k) v[k] -= along * other[k];
  const double length = std::sqrt(detail::dot<n>(v, v));
  if (length < 1e-4) return std::nullopt;
  for (double& x : v) x /= length;
  return v;
}

/// Conditions of one node: components of the velocity and of the mesh, counted in a frame where `turned`.
template <int n>
struct NodeConditions {
  HeldComponents<n> velocity, mesh;
};

/// \param mirrored  directions along which neither moves
/// \param open      and those along which the mesh does not
template <int n>
NodeConditions<n> conditions_along(const std::vector<Direction<n>>& mirrored, const std::vector<Direction<n>>& open) {
  auto directions = mirrored;
  directions.insert(directions.end(), open.begin(), open.end());
  NodeConditions<n> result{hold<n>(mirrored), hold<n>(directions)};
  const auto count = [](const HeldComponents<n>& held) { return std::count(held.held.begin(), held.held.end(), true); };
  const auto of_mirrors = count(result.velocity), of_both = count(result.mesh);
  if (of_both == of_mirrors) {
    result.mesh = result.velocity;
  } else if (of_both == n) {  // in any frame
    result.mesh.turned = result.velocity.turned;
    result.mesh.axes = result.velocity.axes;
  } else if (of_mirrors == 0) {
    result.velocity.turned = result.mesh.turned;
    result.velocity.axes = result.mesh.axes;
  } else if constexpr (n == 3) {  // one direction of a mirror, and one more: a frame of these two
    const auto& s = mirrored.front();
    Direction<n> t{};
    for (const auto& direction : directions)
      if (const auto found = across<n>(direction, s)) t = *found;
    if (detail::axis_along<n>(s) >= 0 && detail::axis_along<n>(t) >= 0) return result;
    HeldComponents<n> frame;
    frame.turned = true;
    frame.axes = {s, t, {s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2], s[0] * t[1] - s[1] * t[0]}};
    result.velocity = result.mesh = frame;
    result.velocity.held = {true, false, false};
    result.mesh.held = {true, true, false};
  }
  return result;
}

}  // namespace

template <class Element>
std::vector<std::optional<MovingOpening<Element::components>>> moving_openings(
    const MeshOf<Element>& mesh, const PartOf<Element>& fluid,
    const std::vector<OpenBoundary<Element::components>>& open, const std::vector<char>& wet,
    const WallSide<Element>& wall) {
  std::vector<std::optional<MovingOpening<Element::components>>> found(open.size());
  for (std::size_t i = 0; i < open.size(); ++i) {
    MovingOpening<Element::components> opening{nodes_on<Element>(fluid, group_facets(mesh, open[i].name())), {}};
    std::vector<int> loose;  // nodes of the wall
    for (int a = 0; a < fluid.node_count(); ++a)
      if (opening.on[a] && wet[a])
        if (const int node = wall.part.local_node[fluid.mesh_node[a]]; !wall.held.conditions.fixes(node))
          loose.push_back(node);
    if (loose.empty()) continue;
    for (const auto& surface : wall.supports)
      if (std::all_of(loose.begin(), loose.end(), [&](int node) { return surface.on[node]; }))
        opening.holds.push_back(surface.direction);
    found[i] = std::move(opening);
  }
  return found;
}

template <class Element>
void hold_with_openings(const MeshOf<Element>& mesh, const PartOf<Element>& fluid,
                        const std::vector<std::optional<MovingOpening<Element::components>>>& moving,
                        const std::vector<char>& wet, const WallSide<Element>& wall, FluidBoundary<Element>& boundary) {
  constexpr int n = Element::components;
  const HeldDirections<Element> directions(mesh, fluid);
  for (int a = 0; a < fluid.node_count(); ++a) {
    if (wet[a]) {
      if (const auto* axes = wall.held.frames.at(wall.part.local_node[fluid.mesh_node[a]]))
        boundary.frames.turn(a, *axes);
      continue;
    }
    std::vector<Direction<n>> held;
    for (const auto& opening : moving)
      if (opening && opening->on[a]) held.insert(held.end(), opening->holds.begin(), opening->holds.end());
    const auto conditions = conditions_along<n>(directions.of_symmetry(a), held);
    if (conditions.velocity.turned) boundary.frames.turn(a, conditions.velocity.axes);
    for (int k = 0; k < n; ++k) {
      if (conditions.velocity.held[k]) boundary.velocity.fix(a, k);
      if (conditions.mesh.held[k]) boundary.mesh.fix(a, k);
    }
  }
}

template <int n>
void require_no_profile_where_openings_move(const Case& setup, const std::vector<OpenBoundary<n>>& open) {
  const auto openings = openings_of(setup);
  for (std::size_t i = 0; i < open.size(); ++i)
    if (const auto& rate = openings[i].flow_rate; open[i].moving() && rate && rate->profile != FlowRateData{}.profile)
      throw InputError(setup.path.string(), "opening." + open[i].name() + ".profile",
                       "the wall's end at this opening is not clamped: the opening moves with it, and of a flow that "
                       "is given there the velocity is found with the step",
                       "remove profile, or fix all components of the wall's end there");
}
template void require_no_profile_where_openings_move<2>(const Case&, const std::vector<OpenBoundary<2>>&);
template void require_no_profile_where_openings_move<3>(const Case&, const std::vector<OpenBoundary<3>>&);

#define FSI_INSTANTIATE(Element)                                                                                   \
  template std::vector<std::optional<MovingOpening<Element::components>>> moving_openings<Element>(                \
      const MeshOf<Element>&, const PartOf<Element>&, const std::vector<OpenBoundary<Element::components>>&,       \
      const std::vector<char>&, const WallSide<Element>&);                                                         \
  template void hold_with_openings<Element>(const MeshOf<Element>&, const PartOf<Element>&,                        \
                                            const std::vector<std::optional<MovingOpening<Element::components>>>&, \
                                            const std::vector<char>&, const WallSide<Element>&,                    \
                                            FluidBoundary<Element>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
