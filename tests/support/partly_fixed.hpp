#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "support/random.hpp"
#include "system/system.hpp"

namespace fsi::test {

/// The numbering without the unknowns and equations that `dropped(index)` names; the others close up.
template <class Dropped>
Numbering without_unknowns(Numbering numbering, Dropped dropped) {
  std::vector<std::int64_t> number(static_cast<std::size_t>(numbering.size), -1);
  std::int64_t next = 0;
  for (std::int64_t i = 0; i < numbering.size; ++i)
    if (!dropped(i)) number[i] = next++;
  for (UnknownMap* map : {&numbering.mesh_rows, &numbering.mesh, &numbering.fluid_rows, &numbering.fluid,
                          &numbering.wall_rows, &numbering.wall})
    for (Unknown& unknown : *map)
      if (unknown.index >= 0) unknown.index = number[unknown.index];
  numbering.size = next;
  return numbering;
}

/// Some nodes of a part that can move lose one component of their vector, or its scalar, or both: as on symmetry
/// planes, at rollers, and at nodes that carry no pressure.
/// \param share  of the nodes that lose something
template <int n>
void drop_some(const UnknownMap& map, bool vectors, bool scalars, double share, Random& random,
               std::vector<char>& dropped) {
  for (std::size_t node = 0; node < map.size() / (n + 1); ++node) {
    if (random() > 2 * share - 1) continue;
    const auto entry = [&](int k) { return map[node * (n + 1) + k].index; };
    const int k = static_cast<int>((random() + 1) / 2 * n);
    if (vectors && entry(k) >= 0) dropped[entry(k)] = 1;
    if (scalars && entry(n) >= 0) dropped[entry(n)] = 1;
  }
}

/// The coupled system of a scene linearised at a random state, single unknowns left out.
template <int n>
class PartlyFixedSystem {
 public:
  PartlyFixedSystem(Scene<n>& scene, Numbering numbering, bool vectors, bool scalars, double share = 0.2) {
    Random random(5);
    std::vector<char> dropped(static_cast<std::size_t>(numbering.size), 0);
    drop_some<n>(numbering.fluid, vectors, scalars, share, random, dropped);
    drop_some<n>(numbering.wall, vectors, scalars, share, random, dropped);
    numbering = without_unknowns(numbering, [&](std::int64_t i) { return dropped[i] != 0; });
    system_ = std::make_unique<System<n>>("coupled", scene, std::move(numbering));
    State state = scene.at_rest();
    StepData data;
    data.rates = scene.integrator->rates(state, 0.125);
    if (scene.fluid) data.opening_pressures = {1.332};
    if (scene.fluid) {
      state.now.fluid = random_field(scene.fluid->nodes().nodes, n + 1, 0.3, 1e-3, 1);
      if (scene.coupled()) state.now.mesh = random_field(scene.fluid->nodes().nodes, n, 1e-3, 1e-5, 2);
    }
    if (scene.wall) state.now.wall = random_field(scene.wall->nodes().nodes, n + 1, 1e-3, 1e-5, 3);
    system_->work_on(state, data);
    system_->evaluate();
    system_->linearise();
    for (std::int64_t i = 0; i < system_->numbering().size; ++i) b.push_back(random());
    DirectLinearSolver<n> direct(blocks());
    direct.update();
    direct.solve(b, 0, solution);
  }

  JacobianBlocks<n> blocks() { return system_->blocks(); }
  std::vector<double> b, solution;  ///< random, and J^-1 b by sparse factorisation

 private:
  std::unique_ptr<System<n>> system_;
};

}  // namespace fsi::test
