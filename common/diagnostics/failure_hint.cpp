#include "diagnostics/failure_hint.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "diagnostics/limit_load.hpp"
#include "fem/dimensions.hpp"
#include "fem/nodal_layout.hpp"
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

/// The first of all processes' extremes in the order of `less`; of equal ones the first process's.
template <class Less>
Extreme first_of(const Communicator& processes, const Extreme& mine, Less less) {
  const auto all = processes.gather(std::vector<double>{mine.value, mine.where[0], mine.where[1], mine.where[2]});
  std::size_t first = 0;
  for (std::size_t at = 4; at < all.size(); at += 4)
    if (less(all[at], all[first])) first = at;
  return {all[first], {all[first + 1], all[first + 2], all[first + 3]}};
}

/// Positions of the nodes after their displacement; `stride` numbers per node, the components along `axes`.
template <std::size_t n>
std::vector<Point> moved(const std::vector<Point>& points, const std::vector<double>& displacement, std::size_t stride,
                         const std::array<int, n>& axes) {
  std::vector<Point> now = points;
  for (std::size_t node = 0; node < points.size(); ++node)
    for (std::size_t k = 0; k < n; ++k) now[node][axes[k]] += displacement[node * stride + k];
  return now;
}

/// \param vertices  of the elements, `per_cell` numbers each
Extreme largest_stretch(const std::vector<int>& vertices, int per_cell, const std::vector<Point>& at_rest,
                        const std::vector<Point>& now) {
  Extreme largest{1, {}};
  for (std::size_t cell = 0; cell < vertices.size(); cell += per_cell)
    for (int a = 0; a < per_cell; ++a)
      for (int b = 0; b < a; ++b) {
        const int i = vertices[cell + a], j = vertices[cell + b];
        const double stretch = distance(now[i], now[j]) / distance(at_rest[i], at_rest[j]);
        if (stretch > largest.value) largest = {stretch, 0.5 * (at_rest[i] + at_rest[j])};
      }
  return largest;
}

/// Which other mesh motions would follow further (docs/theory.md, section 6).
std::string remedy_of(MeshMotionMethod method) {
  const auto quoted = [](MeshMotionMethod other) { return "\"" + mesh_motion_methods().name_of(other) + "\""; };
  switch (method) {
    case MeshMotionMethod::harmonic:
      return fmt::format(", but mesh_motion.method = {} or {} can", quoted(MeshMotionMethod::stiffened),
                         quoted(MeshMotionMethod::nonlinear_elastic));
    case MeshMotionMethod::stiffened:
      return fmt::format(", but mesh_motion.method = {} can", quoted(MeshMotionMethod::nonlinear_elastic));
    case MeshMotionMethod::nonlinear_elastic:
      break;
  }
  return {};
}

/// The smallest J of a mesh displacement and the centre of its cell; NaN if one is NaN.
template <int n>
Extreme smallest_volume_ratio(const Scene<n>& scene, const std::vector<double>& mesh) {
  const AssemblyResult here = scene.smallest_volume_ratio(mesh);
  Extreme smallest{here.smallest_volume_ratio, {0, 0, 0}};
  if (here.cell >= 0) {
    const auto vertices = scene.fluid->cell_vertices();
    const auto& at_rest = scene.fluid->nodes().nodes;
    for (int a = 0; a <= n; ++a)
      smallest.where = smallest.where + (1.0 / (n + 1)) * at_rest[vertices[here.cell * (n + 1) + a]];
  }
  return first_of(scene.processes(), smallest,
                  [](double a, double b) { return !std::isnan(b) && (std::isnan(a) || a < b); });
}

/// About an element that the mesh motion is about to fold: it is small at the last level, or would be folded at the
/// next one if the mesh went on as in the last step.
template <int n>
std::string mesh_hint(const Case& setup, const Scene<n>& scene, const State& state, const AxisFrame& frame) {
  const auto &now = state.before[0].mesh, &last = state.before[1].mesh;
  Extreme smallest = smallest_volume_ratio(scene, now);
  const bool small = !(smallest.value > squeezed);
  if (!small) {
    std::vector<double> next(now.size());
    for (std::size_t i = 0; i < next.size(); ++i) next[i] = 2 * now[i] - last[i];
    const Extreme then = smallest_volume_ratio(scene, next);
    if (then.value > 0) return {};
    smallest.where = then.where;
  }
  const std::string what = !small               ? "folds as the wall moves on"
                           : smallest.value > 0 ? fmt::format("has {:.2g} % of its volume left", 100 * smallest.value)
                                                : "is folded";
  return fmt::format(
      "a mesh element of the fluid near z = {:.1f} mm {}: the mesh cannot follow this motion much "
      "further{}",
      frame.axial(smallest.where), what, remedy_of(setup.mesh_motion.method));
}

/// What is known of a wall that gave way.
struct WallAtFailure {
  Extreme stretch;       ///< at the last finished level
  bool growing = false;  ///< it was far already and grew in each of the last levels: no accident of one step
  double axial = 0;      ///< mm, where it is
  double load = 0;       ///< kPa, largest until the step that failed; at rest, that step's
  double mean_load = 0;  ///< kPa, over the time until then; at rest, that step's
};

/// The load; of a run in time all until now, since it may have ended while the wall still yields.
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

template <int n>
std::string failure_hint(const Case& setup, const Scene<n>& scene, const Loads& loads, const State& state) {
  constexpr int per_cell = n + 1;
  std::vector<std::string> found;
  const Axis axis = setup.structure ? Axis{setup.structure->axis_origin, setup.structure->axis_direction} : Axis{};
  const AxisFrame frame(axis);
  if (scene.wall) {
    const auto vertices = scene.wall->cell_vertices();
    const auto& at_rest = scene.wall->nodes().nodes;
    std::array<Extreme, 3> levels;
    for (int k = 0; k < 3; ++k)
      levels[k] = first_of(scene.processes(),
                           largest_stretch(vertices, per_cell, at_rest,
                                           moved(at_rest, state.before[k].wall, MixedLayout<n>::entries, scene.axes)),
                           [](double a, double b) { return a > b; });
    WallAtFailure wall{levels[0]};
    wall.growing = state.step >= 3 && levels[0].value > levels[1].value && levels[1].value > levels[2].value &&
                   levels[2].value > already_stretched;
    wall.axial = frame.axial(wall.stretch.where);
    const bool is_static = setup.static_load.has_value();
    add_load(wall, loads, state.step + 1, is_static);
    const bool bare = !setup.prestress && !scene.wall->supports();  // of others the limit is not known
    const auto limit = bare ? tube_limit_load(*setup.structure, *scene.wall) : std::nullopt;
    const auto text = wall_hint(wall, limit, is_static);
    if (!text.empty()) found.push_back(text);
  }
  if (scene.coupled())
    if (const auto text = mesh_hint(setup, scene, state, frame); !text.empty()) found.push_back(text);
  return fmt::format("{}", fmt::join(found, "; "));
}

#define FSI_INSTANTIATE(n) template std::string failure_hint(const Case&, const Scene<n>&, const Loads&, const State&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
