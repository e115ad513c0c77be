#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fem/p1_tetrahedron.hpp"
#include "mesher/artery_generator.hpp"
#include "monolithic/coupled_solvers/amg/transfer.hpp"
#include "scene/build_scene.hpp"
#include "scene/loads.hpp"
#include "support/scenes.hpp"

namespace fsi::test {

/// The three sub-problem matrices of the coupled system of the artery, boundary conditions imposed: the fluid free on
/// the interface, the wall and the mesh motion given there.
struct ArteryMatrices {
  Case setup;
  std::unique_ptr<Scene<3>> scene;
  BlockMatrix<4, 4> fluid, wall;
  BlockMatrix<1, 1> mesh;
  NodeMarks fluid_marks, wall_marks, mesh_marks;

  /// \param moving  linearised at a smooth flow and deformation, not at rest
  ArteryMatrices(const ArteryOptions& options, const std::string& material, bool moving = false)
      : setup(coupled_case(material)) {
    scene = build_scene<P1Tetrahedron>(setup, generate_artery(options));
    State state = scene->at_rest();
    if (moving) {
      const auto wave = [](const Point& x, int k) { return std::sin(0.7 * x[0] + 0.4 * x[1] + 0.3 * x[2] + k); };
      for (int a = 0; a < scene->fluid->node_count(); ++a)
        for (int k = 0; k < 3; ++k) {
          state.now.mesh[a * 3 + k] = 0.01 * wave(scene->fluid->nodes().nodes[a], k);
          state.now.fluid[a * 4 + k] = 0.5 * wave(scene->fluid->nodes().nodes[a], k + 3);
        }
      for (int a = 0; a < scene->wall->node_count(); ++a)
        for (int k = 0; k < 3; ++k) state.now.wall[a * 4 + k] = 0.02 * wave(scene->wall->nodes().nodes[a], k);
    }
    Loads loads(setup);
    const StepData data = loads.next(state, *scene->integrator);
    std::vector<double> rows;
    FluidJacobian<3> of_fluid(scene->fluid->graph(), FluidDerivatives::fluid);
    scene->fluid->assemble(scene->fluid_input(state, data.rates), data.opening_pressures, rows, &of_fluid);
    fluid = std::move(of_fluid.fluid);
    wall = WallMatrix<3>(scene->wall->graph());
    scene->wall->assemble(scene->wall_input(state, data.rates), 0, state.now.wall, rows, &wall);
    mesh = BlockMatrix<1, 1>(scene->mesh_motion.graph);
    for (int at = 0; at < mesh.graph->blocks(); ++at) mesh.values[at] = scene->mesh_motion.block(at)[0];

    fluid_marks = NodeMarks(fluid.graph->rows());
    mesh_marks = fluid_marks;
    wall_marks = NodeMarks(wall.graph->rows());
    fluid_marks.prescribed = fixed_nodes(scene->velocity_conditions);
    mesh_marks.prescribed = fixed_nodes(scene->mesh_conditions);
    wall_marks.prescribed = fixed_nodes(scene->wall_conditions);
    for (const auto& node : scene->interface) {
      fluid_marks.interface[node.fluid] = mesh_marks.interface[node.fluid] = 1;
      wall_marks.interface[node.wall] = 1;
    }
    prescribe(fluid, fluid_marks.prescribed, 3, 1.0, true);
    prescribe(wall, wall_marks.prescribed, 3, 1.0, true);
    prescribe(mesh, mesh_marks.prescribed, 1, 1.0, true);
    std::vector<char> given(wall.graph->rows(), 0);
    for (const auto& node : scene->interface) given[node.wall] = !node.clamped;
    prescribe(wall, given, 3, data.rates.interface.rate(), false);
    given.assign(mesh.graph->rows(), 0);
    for (const auto& node : scene->interface) given[node.fluid] = !scene->mesh_conditions.fixes(node.fluid);
    prescribe(mesh, given, 1, 1.0, false);
  }

  static std::vector<char> fixed_nodes(const DirichletConditions<3>& conditions) {
    std::vector<char> fixed(static_cast<std::size_t>(conditions.node_count()), 0);
    for (int a = 0; a < conditions.node_count(); ++a) fixed[a] = conditions.fixes(a);
    return fixed;
  }

  /// Replaces vector rows by diagonal ones and clears, if asked, the columns.
  template <int Size>
  static void prescribe(BlockMatrix<Size, Size>& a, const std::vector<char>& nodes, int vector, double diagonal,
                        bool clear_columns) {
    for (int i = 0; i < a.graph->rows(); ++i)
      for (int at = a.graph->offsets[i]; at < a.graph->offsets[i + 1]; ++at) {
        const int j = a.graph->columns[at];
        double* block = a.block(at);
        for (int r = 0; r < Size; ++r)
          for (int c = 0; c < Size; ++c) {
            const bool row = nodes[i] && r < vector, column = clear_columns && nodes[j] && c < vector;
            if (row || column) block[r * Size + c] = row && i == j && r == c ? diagonal : 0.0;
          }
      }
  }
};

}  // namespace fsi::test
