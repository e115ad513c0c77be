#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "diagnostics/energy_balance.hpp"
#include "support/element_meshes.hpp"
#include "support/problems.hpp"
#include "support/scenes.hpp"
#include "support/supported_meshes.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test {

/// What became of a pulled block at the end.
struct PulledBlock {
  bool viscous = false;
  double stretch = 1;
  double work = 0, dissipated = 0, stored = 0, left_over = 0;  ///< uJ
};

/// A cube, a square, or a ring of inner radius 1, of one nearly incompressible layer of hardly any mass, free across, under a
/// traction `pull` t (kPa/ms) along its last axis until `end` (ms).
template <class Element>
PulledBlock pulled_block(const MaterialData& layer, const std::string& scheme, int steps, double end, double pull) {
  constexpr int n = Element::components;
  const int axis = Element::axis[n - 1];
  const double first = Element::axisymmetric ? 1 : 0;
  auto mesh = irregular_mesh<Element>(1, "media");
  Case setup;
  setup.structure = StructureData{};
  setup.structure->density = 1e-6;
  setup.structure->bulk_modulus = 1e8;
  setup.structure->layers["media"] = layer;
  for (int k = 0; k < n; ++k) {
    if (Element::axisymmetric && k == 0) continue;
    const std::string name = std::string("low_") + "xyz"[Element::axis[k]];
    name_boundary(mesh, name,
                  [&](const Point& x) { return std::abs(x[Element::axis[k]] - (k == 0 ? first : 0.0)) < 1e-9; });
    setup.supports[name].fixed = {"normal"};
  }
  name_boundary(mesh, "high", [&](const Point& x) { return std::abs(x[axis] - 1) < 1e-9; });
  for (int k = 0; k < n; ++k)
    setup.supports["high"].traction.push_back(k == n - 1 ? PressureTable{{{0.0, 0.0}, {2 * end, 2 * end * pull}}}
                                                         : PressureTable{{{0.0, 0.0}}});
  setup.time.emplace();
  setup.time->step = end / steps;
  setup.time->end = end;
  setup.time->scheme = scheme;
  // The scene's own shift, made for its waves, which hardly any mass makes fast, would be at its bound: first order.
  if (scheme == "midpoint") setup.time->scheme_values["damping"] = 0.1;
  const auto scene = build_scene<Element>(setup, mesh);
  const Loads loads(setup);
  NewtonOptions options;
  options.tolerance = 1e-11;
  options.mode = NewtonMode::full;
  NewtonStepper<n> stepper(*scene, loads, options, number_wall(*scene));
  stepper.keep_balances(true);
  State state = scene->at_rest();
  EnergyBalance<n> balance(*scene, state);
  PulledBlock block;
  block.viscous = scene->wall->is_viscous();
  while (state.step < loads.steps()) {
    const StepReport report = stepper.advance(state);
    const EnergyRecord record = balance.step_to(state, report);
    block.work += record.support_work;
    block.dissipated += record.wall_viscous;
    block.stored = record.energy();
    block.left_over = std::max(block.left_over, std::abs(record.remainder));
  }
  const auto& x = scene->wall->nodes().nodes;
  for (std::size_t a = 0; a < x.size(); ++a)
    if (std::abs(x[a][axis] - 1) < 1e-9)
      block.stretch = 1 + state.before[0].wall[MixedLayout<n>::vector(static_cast<int>(a), n - 1)];
  return block;
}

}  // namespace fsi::test
