#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fem/p1_triangle.hpp"
#include "fluid/fluid_problem.hpp"
#include "mesh_motion/motion_of_vertices.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "scene/wave_speed.hpp"
#include "system/newton_stepper.hpp"
#include "time/euler_newmark.hpp"
#include "wall/wall_problem.hpp"

namespace fsi::test {

/// The paper's artery as a body of revolution: the same weak forms, assembly, numbering and Newton stepper as in three
/// dimensions, instantiated for P1AxisymmetricTriangle on a structured grid. With the same element
/// size it has a fiftieth of the unknowns, so that it can be refined until it serves as a reference for the error of
/// the mesh, not of the weak forms.
class AxisymmetricArtery {
 public:
  using Element = P1AxisymmetricTriangle;

  /// \param material    "neo-hookean", "mooney-rivlin" or "artery"
  /// \param refinement  1: 4 cells across the fluid, 2 the media, 1 the adventitia, 36 along the axis; 2: twice those
  /// \param step        ms
  /// \param alpha       factor of the wall's stabilisation
  /// \param kind        of stabilisation
  AxisymmetricArtery(const std::string& material, int refinement, double step = 0.125, double alpha = 0.5,
                     Stabilisation kind = Stabilisation::paper)
      : axial_cells_(36 * refinement), alpha_(alpha) {
    make_grid(refinement);
    setup_.fluid = FluidData{1.0, 3.5e-3};
    setup_.inlet = PressureTable{{{0, 1.332}, {0.125, 1.332}, {0.125, 0}}};
    setup_.time = TimeData{};
    setup_.time->step = step;
    setup_.time->end = 12;
    make_scene(material);
    if (kind == Stabilisation::projected) stabilise_for_waves(*scene_);
    loads_ = std::make_unique<Loads>(setup_);
    stepper_ =
        std::make_unique<NewtonStepper<Element::components>>(*scene_, *loads_, NewtonOptions{}, number_scene(*scene_));
    state_ = scene_->at_rest();
  }

  void step() { stepper_->advance(state_); }
  double time() const { return state_.time; }
  const Case& setup() const { return setup_; }
  Scene<Element::components>& scene() { return *scene_; }
  std::int64_t unknowns() const { return stepper_->system().numbering().size; }

  /// Pressure on the axis in Pa at z = 0, 0.1, ..., 18 mm.
  std::vector<double> centre_line() const {
    return along([this](int k) { return 1000 * on_axis(k); });
  }

  /// Radial displacement of the inner wall in mm at the same places.
  std::vector<double> inner_wall() const {
    return along([this](int k) { return radial(k); });
  }

 private:
  static constexpr double inner = 1.43, media = 0.26, adventitia = 0.13, length = 18;

  int node(int i, int k) const { return k * static_cast<int>(radii_.size()) + i; }
  double on_axis(int k) const {
    return state_.now.fluid[MixedLayout<2>::scalar(scene_->fluid->nodes().local_node[node(0, k)])];
  }
  double radial(int k) const {
    return state_.now.wall[MixedLayout<2>::vector(scene_->wall->nodes().local_node[node(fluid_cells_, k)])];
  }

  /// Of nodal values per station, at z = 0, 0.1, ..., 18 mm.
  template <class Value>
  std::vector<double> along(const Value& value) const {
    std::vector<double> values;
    for (int i = 0; i <= 180; ++i) {
      const double y = i * 0.1 / length * axial_cells_;
      const int below = std::min(static_cast<int>(y), axial_cells_ - 1);
      values.push_back((1 - (y - below)) * value(below) + (y - below) * value(below + 1));
    }
    return values;
  }

  void make_grid(int refinement) {
    fluid_cells_ = 4 * refinement;
    const int media_cells = 2 * refinement, adventitia_cells = refinement;
    for (int i = 0; i <= fluid_cells_; ++i) radii_.push_back(inner * i / fluid_cells_);
    for (int i = 1; i <= media_cells; ++i) radii_.push_back(inner + media * i / media_cells);
    for (int i = 1; i <= adventitia_cells; ++i) radii_.push_back(inner + media + adventitia * i / adventitia_cells);
    mesh_.regions = {"fluid", "media", "adventitia"};
    for (int k = 0; k <= axial_cells_; ++k)
      for (double r : radii_) mesh_.nodes.push_back({r, 0, length * k / axial_cells_});
    for (int k = 0; k < axial_cells_; ++k)
      for (int i = 0; i + 1 < static_cast<int>(radii_.size()); ++i) {
        const int a = node(i, k), b = node(i + 1, k), c = node(i + 1, k + 1), d = node(i, k + 1);
        if ((i + k) % 2)
          mesh_.cells.insert(mesh_.cells.end(), {{a, b, c}, {a, c, d}});
        else
          mesh_.cells.insert(mesh_.cells.end(), {{a, b, d}, {b, c, d}});
        const int region = i < fluid_cells_ ? 0 : (i < fluid_cells_ + media_cells ? 1 : 2);
        mesh_.cell_region.insert(mesh_.cell_region.end(), {region, region});
      }
  }

  static Material layer(const std::string& material, bool of_media) {
    const double c10 = of_media ? 3.0 : 0.3;
    if (material == "mooney-rivlin") return MooneyRivlin{c10, of_media ? 0.3 : 0.2};
    if (material == "artery") return of_media ? Artery{c10, 2.3632, 0.8393, 1, 29} : Artery{c10, 0.5620, 0.7112, 1, 62};
    return NeoHookean{c10};
  }

  void make_scene(const std::string& material) {
    scene_ = std::make_unique<Scene<Element::components>>();
    scene_->integrator = std::make_unique<EulerNewmark<Element::components>>();
    auto fluid = submesh(mesh_, {0}), wall = submesh(mesh_, {1, 2});
    std::vector<TriangleMesh::Facet> inlet, outlet;
    for (int i = 0; i < fluid_cells_; ++i) {
      inlet.push_back(fluid.local({node(i, 0), node(i + 1, 0)}));
      outlet.push_back(fluid.local({node(i + 1, axial_cells_), node(i, axial_cells_)}));
    }
    const auto at_end = [](const Point& x) { return x[2] < 1e-9 || x[2] > length - 1e-9; };
    scene_->wall_conditions = DirichletConditions<2>(wall.node_count());
    for (int a = 0; a < wall.node_count(); ++a)
      if (at_end(wall.nodes[a])) scene_->wall_conditions.fix(a);
    scene_->velocity_conditions = scene_->mesh_conditions = DirichletConditions<2>(fluid.node_count());
    for (int a = 0; a < fluid.node_count(); ++a) {
      const bool end = at_end(fluid.nodes[a]), wet = fluid.nodes[a][0] > inner - 1e-9;
      if (end) scene_->mesh_conditions.fix(a);
      if (end && wet) scene_->velocity_conditions.fix(a);
      if (wet) scene_->interface.push_back({a, wall.local_node[fluid.mesh_node[a]], end});
    }
    scene_->wall = std::make_unique<WallProblem<Element>>(
        std::move(wall), WallConstants{1.2, 1e5, alpha_},
        std::vector<std::pair<int, Material>>{{1, layer(material, true)}, {2, layer(material, false)}}, CylinderAxis{});
    std::vector<OpenBoundary<2>> open{open_boundary<Element>("inlet", fluid.nodes, inlet),
                                      open_boundary<Element>("outlet", fluid.nodes, outlet)};
    auto problem = std::make_unique<FluidProblem<Element>>(std::move(fluid), AleFluid{1.0, 3.5e-3}, std::move(open));
    scene_->mesh_motion_problem =
        harmonic_mesh_motion<Element>(problem->part(), problem->packs(), problem->space().graph());
    scene_->fluid = std::move(problem);
    scene_->assemble_mesh_motion();
  }

  int axial_cells_, fluid_cells_ = 0;
  double alpha_;
  std::vector<double> radii_;
  TriangleMesh mesh_;
  Case setup_;
  std::unique_ptr<Scene<Element::components>> scene_;
  std::unique_ptr<Loads> loads_;
  std::unique_ptr<NewtonStepper<Element::components>> stepper_;
  State state_;
};

}  // namespace fsi::test
