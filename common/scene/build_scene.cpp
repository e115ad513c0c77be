#include "scene/build_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "case/network_data.hpp"
#include "fem/elements.hpp"
#include "fluid/backflow.hpp"
#include "fluid/fluid_problem.hpp"
#include "materials/viscosity_law.hpp"
#include "mesh_motion/motion_of_vertices.hpp"
#include "scene/rigid_motion.hpp"
#include "scene/time_scheme.hpp"
#include "scene/varying_materials.hpp"
#include "scene/wave_speed.hpp"
#include "wall/wall_problem.hpp"

namespace fsi {

namespace {

/// beta of the stabilisation of backflow: on by default where the case lists openings, save where their velocity is given.
template <int n>
double backflow_of(const OpeningData& opening, const OpenBoundary<n>& open) {
  const bool velocity = opening.flow_rate && !open.moving();
  return opening.listed && !velocity ? opening.backflow.value_or(BackflowTraction::standard) : 0;
}

CylinderAxis cylinder_axis(const StructureData& data) {
  CylinderAxis axis;
  const auto& d = data.axis_direction;
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  for (int i = 0; i < 3; ++i) {
    axis.origin[i] = data.axis_origin[i];
    axis.direction[i] = d[i] / length;
  }
  return axis;
}

/// \param stiffness  of the cells of the fluid here
template <class Element>
void build_mesh_motion(const MeshMotionOptions& options, const FluidProblem<Element>& fluid,
                       std::vector<double> stiffness, Scene<Element::components>& scene) {
  if (options.method == MeshMotionMethod::nonlinear_elastic)
    scene.nonlinear_mesh_motion = std::make_unique<ElasticMeshMotion<Element>>(
        fluid.packs(), fluid.space().graph(), PseudoSolid::of_poisson(options.poisson), std::move(stiffness));
  else
    scene.mesh_motion_problem =
        harmonic_mesh_motion<Element>(fluid.part(), fluid.packs(), fluid.space().graph(), std::move(stiffness));
}

/// How many cells of these regions the part has, of all processes.
template <class Part>
std::int64_t elements_of(const Part& part, const std::vector<int>& regions) {
  std::int64_t count = 0;
  for (std::size_t c = 0; c < part.cells.size(); ++c)
    if (part.counted.empty() || part.counted[c] != 0)
      count += std::count(regions.begin(), regions.end(), part.cell_region[c]);
  return part.processes().sum(count);
}

template <class Element>
void build_wall(const Case& setup, WallParts<Element> parts, Scene<Element::components>& scene) {
  const auto& s = *setup.structure;
  std::vector<int> regions, with_fibres;
  for (const auto& [region, material] : parts.layers) {
    regions.push_back(region);
    if (has_fibres(material)) with_fibres.push_back(region);
  }
  auto wall = std::make_unique<WallProblem<Element>>(
      std::move(parts.part), WallConstants{s.density, s.bulk_modulus, wall_stabilisation(setup)}, parts.layers,
      cylinder_axis(s), std::move(parts.pressurised), parts.frame ? parts.frame->fields : FrameFields());
  if (parts.frame) {
    scene.fibre_frame = parts.frame->kind;
    scene.remarks.push_back(parts.frame->remark);
    if (!parts.frame->notice.empty()) scene.notices.push_back(parts.frame->notice);
  }
  for (const auto& [name, layer] : s.layers) scene.layer_names.push_back(name);
  scene.volume_factor = s.volume_factor;
  std::size_t number = 0;
  for (const auto& [name, layer] : s.layers) wall->set_viscosity(number++, layer.viscosity);
  std::vector<std::vector<MaxwellBranch>> branches;
  for (const auto& [name, layer] : s.layers) branches.push_back(layer.maxwell);
  wall->set_branches(branches, parts.whole_cells);
  scene.profile.count("structure elements", elements_of(wall->part(), regions));
  if (!with_fibres.empty()) scene.profile.count("elements with fibres", elements_of(wall->part(), with_fibres));
  vary_materials(setup, *wall, scene);
  if (const auto& part = wall->part(); !scene.wall_constants.empty() && part.share)
    scene.wall_cell_order.emplace(part.processes(), std::move(parts.whole_cells), part.counted,
                                  elements_of(part, regions));
  support_wall<Element>(setup, parts.supports, *wall);
  scene.wall_conditions = std::move(parts.held.conditions);
  scene.wall_frames = std::move(parts.held.frames);
  scene.wall = std::move(wall);
}

template <class Element>
void build_fluid(const Case& setup, FluidParts<Element> parts, Scene<Element::components>& scene) {
  constexpr int n = Element::components;
  auto& boundary = parts.boundary;
  AleFluid form{setup.fluid->density, setup.fluid->viscosity, setup.fluid->grad_div};
  if (const auto& model = setup.fluid->viscosity_model) form.law = viscosity_laws().at(model->name).make(model->values);
  auto fluid = std::make_unique<FluidProblem<Element>>(std::move(parts.part), form, std::move(boundary.open),
                                                       std::move(boundary.mirrored));
  scene.profile.count("fluid elements", elements_of(fluid->part(), {parts.region}));
  const auto openings = openings_of(setup);
  const auto& open = fluid->open_boundaries();
  std::vector<typename Openings<n>::Behind> behind;
  for (std::size_t i = 0; i < openings.size(); ++i) {
    if (!open[i].empty()) fluid->stabilise_backflow(i, backflow_of(openings[i], open[i]));
    behind.push_back({openings[i].law ? openings[i].law->make() : nullptr, openings[i].flow_rate && open[i].moving(),
                      openings[i].joined});
  }
  scene.openings = Openings<n>(open, behind, setup.network ? make_network(setup) : nullptr);
  for (Inflow& inflow : parts.inflows) {
    if (!inflow.instead.empty()) scene.notices.push_back(std::move(inflow.instead));
    if (!inflow.remark.empty()) scene.remarks.push_back(std::move(inflow.remark));
    scene.inflows.push_back(prescribed<n>(std::move(inflow), fluid->node_count()));
  }
  scene.interface = std::move(boundary.interface);
  scene.interface_areas = std::move(boundary.interface_areas);
  scene.closed_area = boundary.closed_area;
  scene.interface_ghosts = parts.interface_ghosts;
  scene.velocity_conditions = std::move(boundary.velocity);
  scene.mesh_conditions = std::move(boundary.mesh);
  scene.fluid_frames = std::move(boundary.frames);
  if (scene.wall) build_mesh_motion(setup.mesh_motion, *fluid, std::move(parts.stiffness), scene);
  scene.fluid = std::move(fluid);
}

/// Whether the wall moves a fluid that can pass nowhere.
template <int n>
bool encloses_fluid(const Scene<n>& scene) {
  if (!scene.coupled()) return false;
  const auto& open = scene.fluid->open_boundaries();
  return std::all_of(open.begin(), open.end(), [](const auto& boundary) { return boundary.empty(); });
}

constexpr const char* about_enclosed_fluid =
    "the fluid is enclosed, and nothing but the velocities of each step keeps its volume: while the wall swings it "
    "changes a little in each, one way (in 200 large swings of a ring around its fluid by +1.3 % with midpoint, by the "
    "share theta - 1/2, and by +0.14 % with tr-bdf2); time.scheme = \"midpoint\" with time.damping = 0 keeps it, "
    "exactly so in the plane (docs/theory.md, section 8.12)";

}  // namespace

template <class Element>
std::unique_ptr<Scene<Element::components>> build_scene(const Case& setup, SceneParts<Element>&& parts) {
  constexpr int n = Element::components;
  auto scene = std::make_unique<Scene<n>>();
  scene->remarks = std::move(parts.remarks);
  for (int k = 0; k < n; ++k) scene->axes[k] = Element::axis[k];
  if (parts.wall) build_wall(setup, std::move(*parts.wall), *scene);
  if (parts.fluid) build_fluid(setup, std::move(*parts.fluid), *scene);
  if (!setup.supports.empty()) require_common_frames(setup, *scene);

  if (setup.time) {
    scene->integrator = make_time_scheme(setup, *scene, time_scheme_of(setup, *scene));
    scene->predictor = setup.time->predictor.value_or(std::min(scene->integrator->error_terms().order, 2));
  }
  if (setup.time && encloses_fluid(*scene)) scene->remarks.emplace_back(about_enclosed_fluid);
  if (scene->coupled() && setup.stabilisation == Stabilisation::projected) stabilise_for_waves(*scene);
  if (!setup.supports.empty()) require_no_rigid_motion(setup, *scene);
  scene->keep_constant_operators = setup.economy.keep_constant_operators;
  if (scene->mesh_motion_problem) scene->assemble_mesh_motion();
  return scene;
}

template <class Element>
std::unique_ptr<Scene<Element::components>> build_scene(const Case& setup, const MeshOf<Element>& mesh,
                                                        const MeshShare* share, WholeParts<Element>* whole) {
  assert((share == nullptr) == (whole == nullptr));
  SceneParts<Element> parts = find_parts<Element>(setup, mesh);
  if (share) *whole = restrict_to(*share, parts);
  return build_scene<Element>(setup, std::move(parts));
}

#define FSI_INSTANTIATE(Element)                                                                                 \
  template std::unique_ptr<Scene<Element::components>> build_scene<Element>(const Case&, SceneParts<Element>&&); \
  template std::unique_ptr<Scene<Element::components>> build_scene<Element>(const Case&, const MeshOf<Element>&, \
                                                                            const MeshShare*, WholeParts<Element>*);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
