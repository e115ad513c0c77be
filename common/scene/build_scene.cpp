#include "scene/build_scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/elements.hpp"
#include "fluid/backflow.hpp"
#include "fluid/fluid_problem.hpp"
#include "mesh/boundary.hpp"
#include "mesh/group_names.hpp"
#include "mesh_motion/stiffening.hpp"
#include "scene/boundary_conditions.hpp"
#include "scene/fibre_frame.hpp"
#include "scene/inflow.hpp"
#include "scene/rigid_motion.hpp"
#include "scene/time_scheme.hpp"
#include "scene/wall_supports.hpp"
#include "scene/wave_speed.hpp"
#include "wall/wall_problem.hpp"

namespace fsi {

namespace {

/// beta of the stabilisation of backflow: on by default where the case lists openings, save where their flow is given.
double backflow_of(const OpeningData& opening) {
  return opening.listed && !opening.flow_rate ? opening.backflow.value_or(BackflowTraction::standard) : 0;
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

template <class Element>
void build_mesh_motion(const MeshMotionOptions& options, const FluidProblem<Element>& fluid,
                       Scene<Element::components>& scene) {
  std::vector<int> interface;
  for (const auto& node : scene.interface) interface.push_back(node.fluid);
  auto stiffness = mesh_stiffness(fluid.part(), interface, options);
  if (options.method == MeshMotionMethod::nonlinear_elastic)
    scene.nonlinear_mesh_motion = std::make_unique<ElasticMeshMotion<Element>>(
        fluid.packs(), fluid.space().graph(), PseudoSolid::of_poisson(options.poisson), std::move(stiffness));
  else
    scene.mesh_motion_problem = std::make_unique<MeshMotionOfElements<Element>>(fluid.packs(), std::move(stiffness));
}

}  // namespace

template <class Element>
std::unique_ptr<Scene<Element::components>> build_scene(const Case& setup, const MeshOf<Element>& mesh) {
  constexpr int n = Element::components;
  auto scene = std::make_unique<Scene<n>>();
  for (int k = 0; k < n; ++k) scene->axes[k] = Element::axis[k];

  const int fluid_region = setup.fluid ? mesh.region_index(group::fluid) : -1;
  std::vector<int> wall_regions;
  if (setup.structure)
    for (const auto& [name, data] : setup.structure->layers) wall_regions.push_back(mesh.region_index(name));

  PartOf<Element> wall_part;
  if (setup.structure) {
    wall_part = submesh(mesh, wall_regions);
    if (setup.structure->layer_pressure == LayerPressure::separate) wall_part = split_between_regions(wall_part);
    auto held = wall_conditions<Element>(setup, mesh, wall_part);
    scene->wall_conditions = std::move(held.conditions);
    scene->wall_frames = std::move(held.frames);
    std::vector<std::pair<int, Material>> layers;
    for (const auto& [name, data] : setup.structure->layers)
      layers.push_back({mesh.region_index(name), make_material(data.material, data.values)});
    const auto pressurised = setup.load || setup.prestress
                                 ? in_part<Element>(wall_part, inner_surface<Element>(mesh, wall_regions))
                                 : FacetsOf<Element>{};
    const auto& s = *setup.structure;
    FrameFields frame;
    if (s.fibre_frame == FibreFrame::laplace &&
        std::any_of(layers.begin(), layers.end(), [](const auto& layer) { return has_fibres(layer.second); }))
      frame =
          frame_fields<Element>(wall_part, frame_boundary<Element>(mesh, wall_part, wall_regions, setup.path.string()));
    auto wall = std::make_unique<WallProblem<Element>>(
        wall_part, WallConstants{s.density, s.bulk_modulus, wall_stabilisation(setup)}, layers, cylinder_axis(s),
        pressurised, frame);
    scene->profile.count("structure elements", static_cast<std::int64_t>(wall->element_count()));
    for (const auto& layer : wall->layers())
      if (!layer.fibres.empty())
        scene->profile.count("elements with fibres", static_cast<std::int64_t>(layer.packs.element_count()));
    scene->wall = std::move(wall);
    support_wall<Element>(setup, mesh, wall_part, *scene->wall);
  }

  if (setup.fluid) {
    auto part = submesh(mesh, {fluid_region});
    const auto interface = setup.structure ? interface_facets(mesh, fluid_region, wall_regions) : FacetsOf<Element>{};
    auto boundary =
        fluid_boundary<Element>(openings_of(setup), mesh, part, interface, scene->wall ? &wall_part : nullptr,
                                scene->wall ? &scene->wall_conditions : nullptr);
    for (InflowNodes& nodes : boundary.inflows) {
      MadeInflow<n> made = make_inflow<Element>(setup, mesh, part, std::move(nodes));
      scene->inflows.push_back(std::move(made.inflow));
      if (!made.instead.empty()) scene->notices.push_back(std::move(made.instead));
    }
    scene->velocity_conditions = std::move(boundary.velocity);
    scene->mesh_conditions = std::move(boundary.mesh);
    scene->fluid_frames = boundary.mirrored.frames;
    scene->interface = std::move(boundary.interface);
    scene->interface_areas = std::move(boundary.interface_areas);
    const AleFluid form{setup.fluid->density, setup.fluid->viscosity, setup.fluid->grad_div};
    auto fluid = std::make_unique<FluidProblem<Element>>(std::move(part), form, std::move(boundary.open),
                                                         std::move(boundary.mirrored));
    scene->profile.count("fluid elements", static_cast<std::int64_t>(fluid->element_count()));
    const auto openings = openings_of(setup);
    for (std::size_t i = 0; i < openings.size(); ++i)
      if (!fluid->open_boundaries()[i].empty()) fluid->stabilise_backflow(i, backflow_of(openings[i]));
    if (scene->wall) build_mesh_motion(setup.mesh_motion, *fluid, *scene);
    scene->fluid = std::move(fluid);
  }

  if (!setup.supports.empty()) require_common_frames(setup, *scene);

  if (setup.time) {
    scene->integrator = make_time_scheme(setup, *scene);
    const bool first_order =
        setup.time->scheme == TimeScheme::euler && setup.monolithic.newton.mode != NewtonMode::linearised;
    scene->predictor = setup.time->predictor.value_or(first_order ? 1 : 2);
  }
  if (scene->coupled() && setup.stabilisation == Stabilisation::projected) stabilise_for_waves(*scene);
  if (!setup.supports.empty()) require_no_rigid_motion(setup, *scene);
  scene->keep_constant_operators = setup.economy.keep_constant_operators;
  if (scene->mesh_motion_problem) scene->assemble_mesh_motion();
  return scene;
}

#define FSI_INSTANTIATE(Element) \
  template std::unique_ptr<Scene<Element::components>> build_scene<Element>(const Case&, const MeshOf<Element>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
