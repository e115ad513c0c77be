#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/profile.hpp"
#include "fluid/fluid_problem.hpp"
#include "mesh/simplex_mesh.hpp"
#include "mesh_motion/mesh_motion.hpp"
#include "structure/wall_problem.hpp"
#include "time/state.hpp"
#include "time/time_scheme.hpp"

namespace fsi {

/// A node of the fluid-wall interface in the numbers of both sides.
struct InterfaceNode {
  int fluid, wall;
  bool clamped;  ///< on the wall's clamped ends: nothing moves there
};

/// The sub-problems of one scene with their boundary conditions: what both drivers march in time. Parts that the case
/// does not have are not built.
template <class Element>
class Scene {
 public:
  static constexpr int n = Element::components;

  std::unique_ptr<FluidProblem<Element>> fluid;
  std::unique_ptr<WallProblem<Element>> wall;
  MeshMotionMatrix<Element> mesh_motion;  ///< empty unless fluid and wall meet
  int mesh_motion_assemblies = 0;         ///< what is made of the matrix is as old as the count it was made at
  bool keep_constant_operators = true;    ///< false: assembled at each use, to see what keeping them saves
  std::vector<InterfaceNode> interface;   ///< ascending in the fluid's numbers
  std::vector<char> no_slip;              ///< per fluid node: velocity prescribed zero
  std::vector<char> mesh_fixed;           ///< per fluid node: mesh displacement prescribed zero
  std::vector<char> clamped;              ///< per wall node: displacement prescribed zero
  TimeScheme scheme;
  mutable Profile profile;  ///< also of those who only read the scene

  bool coupled() const { return fluid && wall; }

  /// Assembles the mesh motion's operator; its storage stays in place.
  void assemble_mesh_motion() {
    const auto phase = profile.phase("assembly: mesh motion");
    if (mesh_motion.values.empty()) mesh_motion = MeshMotionMatrix<Element>(fluid->graph());
    fsi::assemble_mesh_motion(fluid->packs(), mesh_motion);
    ++mesh_motion_assemblies;
  }
  /// To be called before each use of operators that never change.
  void renew_constant_operators() {
    if (!keep_constant_operators) assemble_mesh_motion();
  }

  /// The state at rest.
  State at_rest() const {
    State state;
    Solution zero;
    if (fluid) zero.flow.assign(static_cast<std::size_t>(fluid->node_count()) * (n + 1), 0.0);
    if (coupled()) zero.mesh.assign(static_cast<std::size_t>(fluid->node_count()) * n, 0.0);
    if (wall) {
      zero.wall.assign(static_cast<std::size_t>(wall->node_count()) * (n + 1), 0.0);
      state.wall_velocity.assign(static_cast<std::size_t>(wall->node_count()) * n, 0.0);
      state.wall_acceleration = state.wall_velocity;
    }
    state.now = zero;
    state.before = {zero, zero, zero};
    return state;
  }

  /// What the element loops read of a state.
  FluidInput fluid_input(const State& state) const {
    FluidInput in;
    if (coupled()) {
      in.mesh = state.now.mesh.data();
      in.mesh_old = state.before[0].mesh.data();
    }
    in.flow = state.now.flow.data();
    in.flow_old = state.before[0].flow.data();
    return in;
  }
  StructureInput wall_input(const State& state, const StepData& data) const {
    StructureInput in;
    in.wall = state.now.wall.data();
    if (!scheme.is_static()) {
      in.acceleration_history = data.acceleration_history.data();
      in.acceleration_factor = scheme.acceleration_factor();
    }
    return in;
  }

  /// Imposes d_m = d_s and u = (d_s - d_s of the last level) / dt on the interface of state.now.
  void impose_interface(State& state) const {
    for (const auto& node : interface)
      for (int k = 0; k < n; ++k) {
        const std::size_t w = static_cast<std::size_t>(node.wall) * (n + 1) + k;
        state.now.mesh[static_cast<std::size_t>(node.fluid) * n + k] = state.now.wall[w];
        state.now.flow[static_cast<std::size_t>(node.fluid) * (n + 1) + k] =
            (state.now.wall[w] - state.before[0].wall[w]) / scheme.step;
      }
  }
};

}  // namespace fsi
