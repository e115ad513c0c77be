#include "scene/build_scene.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <tuple>
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
#include "scene/moving_openings.hpp"
#include "scene/restricted_conditions.hpp"
#include "scene/rigid_motion.hpp"
#include "scene/time_scheme.hpp"
#include "scene/wall_supports.hpp"
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

/// The numbers of the fluid's nodes on the interface.
template <int n>
std::vector<int> fluid_nodes_of(const std::vector<InterfaceNode>& interface) {
  std::vector<int> nodes;
  for (const auto& node : interface) nodes.push_back(node.fluid);
  return nodes;
}

/// \param stiffness  of the cells of the fluid here
template <class Element>
void build_mesh_motion(const MeshMotionOptions& options, const FluidProblem<Element>& fluid,
                       std::vector<double> stiffness, Scene<Element::components>& scene) {
  if (options.method == MeshMotionMethod::nonlinear_elastic)
    scene.nonlinear_mesh_motion = std::make_unique<ElasticMeshMotion<Element>>(
        fluid.packs(), fluid.space().graph(), PseudoSolid::of_poisson(options.poisson), std::move(stiffness));
  else
    scene.mesh_motion_problem = std::make_unique<MeshMotionOfElements<Element>>(fluid.packs(), std::move(stiffness));
}

/// Pairs of the whole interface in the numbers here, this process's first.
template <int n>
void restrict_interface(const PartRestriction& fluid, const PartRestriction& wall, Scene<n>& scene) {
  const auto whole = std::exchange(scene.interface, {});
  const auto areas = std::exchange(scene.interface_areas, {});
  for (const bool own : {true, false})
    for (std::size_t i = 0; i < whole.size(); ++i) {
      const InterfaceNode node{fluid.local(whole[i].fluid), wall.local(whole[i].wall), whole[i].clamped};
      if (node.fluid < 0 || (fluid.share().owned[node.fluid] != 0) != own) continue;
      scene.interface.push_back(node);
      scene.interface_areas.push_back(areas[i]);
      if (!own) ++scene.interface_copies;
    }
}

/// How many cells of these regions the whole part has.
template <class Part>
std::int64_t elements_of(const Part& part, const std::vector<int>& regions) {
  std::int64_t count = 0;
  for (std::size_t c = 0; c < part.cells.size(); ++c)
    if (part.counted.empty() || part.counted[c] != 0)
      count += std::count(regions.begin(), regions.end(), part.cell_region[c]);
  return part.processes().sum(count);
}

/// An array with a number for each cell of the whole part, as far as they are here.
std::vector<double> of_cells(const std::vector<double>& whole, const std::vector<int>& cells) {
  std::vector<double> here;
  for (const int cell : cells) here.push_back(whole.empty() ? 1 : whole[cell]);
  return whole.empty() ? whole : here;
}

FrameFields restricted(const FrameFields& whole, const PartRestriction& here) {
  return {here.field(whole.radial), here.field(whole.axial), here.field(whole.radial_slope),
          here.field(whole.axial_slope)};
}

template <class Element>
using Boundaries = std::vector<OpenBoundary<Element::components>>;

/// The openings of the whole fluid, at the nodes and facets here.
template <class Element>
Boundaries<Element> openings_here(const Boundaries<Element>& whole, const std::vector<Point>& nodes,
                                  const PartRestriction& here) {
  using Facet = typename MeshOf<Element>::Facet;
  constexpr std::size_t size = std::tuple_size_v<Facet>;
  Boundaries<Element> open;
  for (const auto& boundary : whole) {
    FacetsOf<Element> facets(boundary.facets().size() / size);
    for (std::size_t f = 0; f < facets.size(); ++f)
      std::copy_n(boundary.facets().begin() + static_cast<std::ptrdiff_t>(f * size), size, facets[f].begin());
    const auto touched = here.facets(facets);
    open.push_back(open_boundary<Element>(boundary.name(), nodes, touched, &here.share(), here.counted_facets(facets)));
    if (boundary.moving()) open.back().move_by(moving_surface<Element>(nodes, touched, &here.share()));
    if (boundary.law()) open.back().set_law(*boundary.law(), boundary.place());
    if (boundary.given_flow()) open.back().set_given_flow(*boundary.given_flow());
  }
  return open;
}

}  // namespace

template <class Element>
std::unique_ptr<Scene<Element::components>> build_scene(const Case& setup, const MeshOf<Element>& mesh,
                                                        const MeshShare* share, WholeParts<Element>* whole) {
  constexpr int n = Element::components;
  assert((share == nullptr) == (whole == nullptr));
  auto scene = std::make_unique<Scene<n>>();
  for (int k = 0; k < n; ++k) scene->axes[k] = Element::axis[k];

  const int fluid_region = setup.fluid ? mesh.region_index(group::fluid) : -1;
  std::vector<int> wall_regions;
  if (setup.structure)
    for (const auto& [name, data] : setup.structure->layers) wall_regions.push_back(mesh.region_index(name));

  // All is found on the whole mesh; where it is shared out, each process keeps its part of that.
  PartOf<Element> wall_part;
  WallConditions<n> held;
  if (setup.structure) {
    wall_part = submesh(mesh, wall_regions);
    if (setup.structure->layer_pressure == LayerPressure::separate) wall_part = split_between_regions(wall_part);
    held = wall_conditions<Element>(setup, mesh, wall_part);
    scene->wall_conditions = held.conditions;
    scene->wall_frames = held.frames;
    std::vector<std::pair<int, Material>> layers;
    for (const auto& [name, data] : setup.structure->layers)
      layers.push_back({mesh.region_index(name), make_material(data.material, data.values)});
    auto pressurised = setup.load || setup.prestress
                           ? in_part<Element>(wall_part, inner_surface<Element>(mesh, wall_regions))
                           : FacetsOf<Element>{};
    const auto& s = *setup.structure;
    FrameFields frame;
    if (s.fibre_frame == FibreFrame::laplace &&
        std::any_of(layers.begin(), layers.end(), [](const auto& layer) { return has_fibres(layer.second); }))
      frame =
          frame_fields<Element>(wall_part, frame_boundary<Element>(mesh, wall_part, wall_regions, setup.path.string()));
    PartOf<Element> wall_here;
    if (share) {
      whole->wall = std::make_unique<const PartOf<Element>>(wall_part);
      whole->wall_here = std::make_unique<const PartRestriction>(*whole->wall, *share);
      std::vector<int> cells;
      wall_here = whole->wall_here->part(wall_part, cells);
      pressurised = whole->wall_here->facets(pressurised);
      if (!frame.empty()) frame = restricted(frame, *whole->wall_here);
    }
    auto wall = std::make_unique<WallProblem<Element>>(
        share ? std::move(wall_here) : wall_part, WallConstants{s.density, s.bulk_modulus, wall_stabilisation(setup)},
        layers, cylinder_axis(s), std::move(pressurised), frame);
    scene->profile.count("structure elements", elements_of(wall->part(), wall_regions));
    std::vector<int> with_fibres;
    for (const auto& [region, material] : layers)
      if (has_fibres(material)) with_fibres.push_back(region);
    if (!with_fibres.empty()) scene->profile.count("elements with fibres", elements_of(wall->part(), with_fibres));
    support_wall<Element>(setup, mesh, wall_part, share ? whole->wall_here.get() : nullptr, *wall);
    scene->wall = std::move(wall);
  }

  if (setup.fluid) {
    auto part = submesh(mesh, {fluid_region});
    const auto interface = setup.structure ? interface_facets(mesh, fluid_region, wall_regions) : FacetsOf<Element>{};
    std::optional<WallSide<Element>> side;
    if (scene->wall)
      side.emplace(WallSide<Element>{wall_part, held, surfaces_held_by_supports<Element>(setup, mesh, wall_part)});
    auto boundary = fluid_boundary<Element>(openings_of(setup), mesh, part, interface, side ? &*side : nullptr);
    require_no_profile_where_openings_move(setup, boundary.open);
    const PartRestriction* here = nullptr;
    std::vector<double> stiffness;
    if (scene->wall) stiffness = mesh_stiffness(part, fluid_nodes_of<n>(boundary.interface), setup.mesh_motion);
    scene->interface = std::move(boundary.interface);
    scene->interface_areas = std::move(boundary.interface_areas);
    PartOf<Element> fluid_here;
    if (share) {
      whole->fluid = std::make_unique<const PartOf<Element>>(part);
      whole->fluid_here = std::make_unique<const PartRestriction>(*whole->fluid, *share);
      here = whole->fluid_here.get();
      std::vector<int> cells;
      fluid_here = here->part(part, cells);
      stiffness = of_cells(stiffness, cells);
      boundary.open = openings_here<Element>(boundary.open, fluid_here.nodes, *here);
      boundary.velocity = restricted(boundary.velocity, *here);
      boundary.mesh = restricted(boundary.mesh, *here);
      boundary.mirrored = restricted(boundary.mirrored, *here);
      boundary.frames = restricted(boundary.frames, *here);
      if (scene->wall) {
        restrict_interface(*here, *whole->wall_here, *scene);
        scene->wall_conditions = restricted(scene->wall_conditions, *whole->wall_here);
        scene->wall_frames = restricted(scene->wall_frames, *whole->wall_here);
      }
    }
    for (InflowNodes& nodes : boundary.inflows) {
      MadeInflow<n> made = make_inflow<Element>(setup, mesh, part, std::move(nodes), here);
      scene->inflows.push_back(std::move(made.inflow));
      if (!made.instead.empty()) scene->notices.push_back(std::move(made.instead));
      if (!made.remark.empty()) scene->remarks.push_back(std::move(made.remark));
    }
    scene->velocity_conditions = std::move(boundary.velocity);
    scene->mesh_conditions = std::move(boundary.mesh);
    scene->fluid_frames = std::move(boundary.frames);
    if (share) part = std::move(fluid_here);
    const AleFluid form{setup.fluid->density, setup.fluid->viscosity, setup.fluid->grad_div};
    auto fluid = std::make_unique<FluidProblem<Element>>(std::move(part), form, std::move(boundary.open),
                                                         std::move(boundary.mirrored));
    scene->profile.count("fluid elements", elements_of(fluid->part(), {fluid_region}));
    const auto openings = openings_of(setup);
    for (std::size_t i = 0; i < openings.size(); ++i)
      if (!fluid->open_boundaries()[i].empty())
        fluid->stabilise_backflow(i, backflow_of(openings[i], fluid->open_boundaries()[i]));
    if (scene->wall) build_mesh_motion(setup.mesh_motion, *fluid, std::move(stiffness), *scene);
    scene->fluid = std::move(fluid);
  } else if (share && scene->wall) {
    scene->wall_conditions = restricted(scene->wall_conditions, *whole->wall_here);
    scene->wall_frames = restricted(scene->wall_frames, *whole->wall_here);
  }

  if (!setup.supports.empty()) require_common_frames(setup, *scene);

  if (setup.time) {
    scene->integrator = make_time_scheme(setup, *scene, time_scheme_of(setup, *scene));
    scene->predictor = setup.time->predictor.value_or(std::min(scene->integrator->error_terms().order, 2));
  }
  if (scene->coupled() && setup.stabilisation == Stabilisation::projected) stabilise_for_waves(*scene);
  if (!setup.supports.empty()) require_no_rigid_motion(setup, *scene);
  scene->keep_constant_operators = setup.economy.keep_constant_operators;
  if (scene->mesh_motion_problem) scene->assemble_mesh_motion();
  return scene;
}

#define FSI_INSTANTIATE(Element)                                                                                 \
  template std::unique_ptr<Scene<Element::components>> build_scene<Element>(const Case&, const MeshOf<Element>&, \
                                                                            const MeshShare*, WholeParts<Element>*);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
