#include "diagnostics/failure_hint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "diagnostics/limit_load.hpp"
#include "fem/nodal_layout.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "materials/material.hpp"
#include "mesh/axis.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double far_stretched = 1.25;  // beyond it neo-Hookean tubes soften
constexpr double already_stretched = 1.1;
constexpr double squeezed = 0.2;  // of its volume: the next step may invert the element

/// An extreme value of the deformation and where it is, on the reference mesh.
struct Extreme {
  double value;
  Point where;
};

/// Position of a node after its displacement; `stride` numbers per node.
Point moved(const Submesh<3>& part, const std::vector<double>& displacement, int stride, int node) {
  const double* d = &displacement[static_cast<std::size_t>(node) * stride];
  return part.nodes[node] + Point{d[0], d[1], d[2]};
}

Extreme largest_stretch(const Submesh<3>& part, const std::vector<double>& displacement, int stride) {
  Extreme largest{1, {}};
  for (const auto& cell : part.cells)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < a; ++b) {
        const Point &x = part.nodes[cell[a]], &y = part.nodes[cell[b]];
        const double stretch =
            distance(moved(part, displacement, stride, cell[a]), moved(part, displacement, stride, cell[b])) /
            distance(x, y);
        if (stretch > largest.value) largest = {stretch, 0.5 * (x + y)};
      }
  return largest;
}

Extreme smallest_volume(const Submesh<3>& part, const std::vector<double>& displacement, int stride) {
  Extreme smallest{1, {}};
  for (const auto& cell : part.cells) {
    const auto now = [&](int a) { return moved(part, displacement, stride, cell[a]); };
    const auto& x = part.nodes;
    const double ratio = tetrahedron_volume(now(0), now(1), now(2), now(3)) /
                         tetrahedron_volume(x[cell[0]], x[cell[1]], x[cell[2]], x[cell[3]]);
    if (ratio < smallest.value) smallest = {ratio, 0.25 * (x[cell[0]] + x[cell[1]] + x[cell[2]] + x[cell[3]])};
  }
  return smallest;
}

/// What is known of a wall that gave way.
struct WallAtFailure {
  Extreme stretch;       ///< at the last finished level
  bool growing = false;  ///< it was far already and grew in each of the last levels: no accident of one step
  double axial = 0;      ///< mm, where it is
  double load = 0;       ///< kPa, largest until the step that failed; at rest, that step's
  double mean_load = 0;  ///< kPa, over the time until then; at rest, that step's
};

/// Of a run in time the load until now, which may have ended while the wall still yields.
void add_load(WallAtFailure& wall, const Loads& loads, int last_step, bool at_rest) {
  const int first = at_rest ? last_step : 1;
  for (int step = first; step <= last_step; ++step) {
    double load = loads.wall_pressure(step);
    for (double pressure : loads.opening_pressures(step)) load = std::max(load, pressure);
    wall.load = std::max(wall.load, load);
    wall.mean_load += load / (last_step - first + 1);
  }
}

/// At rest the load alone tells. In time inertia bears any load for a while, and a coupling that is unstable stretches
/// the wall too: only a wall that yields steadily under a load that is too high in the mean has met its limit.
std::string wall_hint(const WallAtFailure& wall, std::optional<double> limit, bool at_rest) {
  const bool far = wall.stretch.value >= far_stretched, beyond = limit && wall.mean_load >= *limit;
  if (at_rest ? !far && !beyond : !(far && beyond && wall.growing)) return {};
  std::string text;
  if (far)
    text = fmt::format("the wall is stretched to {:.2f} times its length near z = {:.1f} mm", wall.stretch.value,
                       wall.axial);
  if (!limit) return text;
  if (far) text += "; ";
  text += fmt::format("a long tube of these layers bears less than {:.3g} kPa at rest", *limit);
  if (beyond)
    text += fmt::format(
        ", so that {:.4g} kPa inflate this one on and on: give a lower pressure, a shorter pulse, stiffer layers, or "
        "fibres (material = \"{}\")",
        wall.load, fmt::join(materials_with_fibres(), "\" or \""));
  else
    text += fmt::format(
        ", less still where it bulges: {:.3g} kPa may be the limit load of this one; on a coarse mesh the wall is too "
        "soft, which a finer mesh tells",
        wall.load);
  return text;
}

}  // namespace

std::string failure_hint(const Case& setup, const TetrahedralMesh& mesh, const Scene<P1Tetrahedron>& scene,
                         const Loads& loads, const State& state) {
  std::vector<std::string> found;
  const Axis axis = setup.structure ? Axis{setup.structure->axis_origin, setup.structure->axis_direction} : Axis{};
  const AxisFrame frame(axis);
  if (scene.wall) {
    std::array<Extreme, 3> levels;
    for (int k = 0; k < 3; ++k)
      levels[k] =
          largest_stretch(scene.wall->part(), state.before[k].wall, MixedLayout<Scene<P1Tetrahedron>::n>::entries);
    WallAtFailure wall{levels[0]};
    wall.growing = state.step >= 3 && levels[0].value > levels[1].value && levels[1].value > levels[2].value &&
                   levels[2].value > already_stretched;
    wall.axial = frame.axial(wall.stretch.where);
    const bool at_rest = setup.static_load.has_value();
    add_load(wall, loads, state.step + 1, at_rest);
    const auto text = wall_hint(wall, tube_limit_load(*setup.structure, mesh), at_rest);
    if (!text.empty()) found.push_back(text);
  }
  if (scene.coupled()) {
    const Extreme volume = smallest_volume(scene.fluid->part(), state.before[0].mesh, Scene<P1Tetrahedron>::n);
    if (volume.value <= squeezed)
      found.push_back(
          fmt::format("a mesh element of the fluid near z = {:.1f} mm has {:.2g} % of its volume left: the mesh "
                      "cannot follow this motion much further",
                      frame.axial(volume.where), 100 * volume.value));
  }
  return fmt::format("{}", fmt::join(found, "; "));
}

}  // namespace fsi
