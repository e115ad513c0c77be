#include "scene/scene_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "base/error.hpp"
#include "fem/elements.hpp"
#include "mesh/boundary.hpp"
#include "mesh/cell_words.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/group_names.hpp"
#include "mesh_motion/stiffening.hpp"
#include "scene/moving_openings.hpp"
#include "scene/pressure_equations.hpp"
#include "scene/restricted_conditions.hpp"

namespace fsi {

namespace {

/// The numbers of the fluid's nodes on the interface.
std::vector<int> fluid_nodes_of(const std::vector<InterfaceNode>& interface) {
  std::vector<int> nodes;
  for (const auto& node : interface) nodes.push_back(node.fluid);
  return nodes;
}

/// Pressures of their own for the layers; what regions have cut out of a layer shares its.
template <class Mesh, class Part>
Part split_between_layers(const StructureData& structure, const Mesh& mesh, Part part) {
  const std::vector<int> regions = part.cell_region;
  for (const auto& [name, data] : structure.layers)
    if (!data.part_of.empty())
      std::replace(part.cell_region.begin(), part.cell_region.end(), mesh.region_index(name),
                   mesh.region_index(data.part_of));
  part = split_between_regions(part);
  part.cell_region = regions;
  return part;
}

template <class Element>
WallParts<Element> find_wall(const Case& setup, const MeshOf<Element>& mesh, const std::vector<int>& regions) {
  const StructureData& structure = *setup.structure;
  WallParts<Element> wall;
  wall.part = submesh(mesh, regions);
  if (structure.layer_pressure == LayerPressure::separate) wall.part = split_between_layers(structure, mesh, wall.part);
  wall.held = wall_conditions<Element>(setup, mesh, wall.part);
  for (const auto& [name, data] : structure.layers)
    wall.layers.push_back({mesh.region_index(name), make_material(data.material, data.values)});
  if (setup.load || setup.prestress)
    wall.pressurised = in_part<Element>(wall.part, inner_surface<Element>(mesh, regions));
  if (std::any_of(wall.layers.begin(), wall.layers.end(), [](const auto& layer) { return has_fibres(layer.second); }))
    wall.frame = wall_frame<Element>(setup, mesh, wall.part, regions);
  wall.supports = support_facets<Element>(setup, mesh, wall.part);
  return wall;
}

/// \param wall  null: there is none
template <class Element>
FluidParts<Element> find_fluid(const Case& setup, const MeshOf<Element>& mesh, const std::vector<int>& wall_regions,
                               const WallParts<Element>* wall) {
  const int region = mesh.region_index(group::fluid);
  FluidParts<Element> fluid;
  fluid.region = region;
  fluid.part = submesh(mesh, {region});
  const auto interface = wall ? interface_facets(mesh, region, wall_regions) : FacetsOf<Element>{};
  std::optional<WallSide<Element>> side;
  if (wall)
    side.emplace(
        WallSide<Element>{wall->part, wall->held, surfaces_held_by_supports<Element>(setup, mesh, wall->part)});
  fluid.boundary = fluid_boundary<Element>(openings_of(setup), mesh, fluid.part, interface, side ? &*side : nullptr);
  require_no_profile_where_openings_move(setup, fluid.boundary.open);
  if (wall) fluid.stiffness = mesh_stiffness(fluid.part, fluid_nodes_of(fluid.boundary.interface), setup.mesh_motion);
  for (InflowNodes& nodes : fluid.boundary.inflows)
    fluid.inflows.push_back(make_inflow<Element>(setup, mesh, fluid.part, std::move(nodes)));
  return fluid;
}

template <class Element>
std::string problem_of(const LostPressures& lost) {
  using Words = CellWords<Element::dim>;
  if (lost.corner())
    return fmt::format("has no equation: the velocity is given at every node of the {} around it, in a corner",
                       lost.cells == 1 ? std::string(Words::cell) : fmt::format("{} {}", lost.cells, Words::cells));
  return fmt::format(
      "is one of {} in {} {} that have {} free components of the velocity beside them: too few equations",
      lost.pressures, lost.cells, Words::cells, lost.velocities);
}

template <class Element>
std::string remedy_of(const Case& setup, const LostPressures& lost) {
  const std::string cells = CellWords<Element::dim>::cells;
  std::string others = "mesh finer there, or take element = \"p1\"";
  if (!lost.corner()) return others;
  const std::string mesh = setup.mesh.file.empty() ? "MESH.msh" : setup.mesh.file.string();
  return fmt::format("fsi-mesh refine {} --times 0 -o NEW.msh divides {} in corners; or {}", mesh, cells, others);
}

/// A remark of where the velocity that a sub-problem has on the interface leaves a pressure without an equation, with what
/// helps; empty: nowhere. \throws InputError where the conditions of the case alone do
template <class Element>
std::string require_pressure_equations(const Case& setup, const FluidParts<Element>& fluid) {
  const auto& boundary = fluid.boundary;
  if (const auto lost = lost_pressures<Element>(fluid.part, boundary.velocity)) {
    const auto& file = setup.mesh.file.empty() ? setup.path : setup.mesh.file;
    throw InputError(file.string(), "pressure at " + place_of(lost->at), problem_of<Element>(*lost),
                     remedy_of<Element>(setup, *lost));
  }
  std::vector<int> given;
  for (const auto& node : boundary.interface) given.push_back(node.fluid);
  const auto lost = lost_pressures<Element>(fluid.part, boundary.velocity, given);
  if (!lost || given.empty()) return "";
  return fmt::format("{} the pressure at {} {}; {}", interface_takes_equations, place_of(lost->at),
                     problem_of<Element>(*lost), remedy_of<Element>(setup, *lost));
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

/// The openings of the whole fluid, at the nodes and facets here.
template <class Element>
std::vector<OpenBoundary<Element::components>> restricted(const std::vector<OpenBoundary<Element::components>>& whole,
                                                          const std::vector<Point>& nodes,
                                                          const PartRestriction& here) {
  using Facet = typename MeshOf<Element>::Facet;
  constexpr std::size_t size = std::tuple_size_v<Facet>;
  std::vector<OpenBoundary<Element::components>> open;
  for (const auto& boundary : whole) {
    FacetsOf<Element> facets(boundary.facets().size() / size);
    for (std::size_t f = 0; f < facets.size(); ++f)
      std::copy_n(boundary.facets().begin() + static_cast<std::ptrdiff_t>(f * size), size, facets[f].begin());
    const auto touched = here.facets(facets);
    open.push_back(open_boundary<Element>(boundary.name(), nodes, touched, &here.share(), here.counted_facets(facets)));
    if (boundary.moving()) open.back().move_by(moving_surface<Element>(nodes, touched, &here.share()));
  }
  return open;
}

/// Pairs of the whole interface in the numbers here, this process's first.
template <class Element>
void restrict_interface(const PartRestriction& here, const PartRestriction& wall, FluidParts<Element>& fluid) {
  const auto whole = std::exchange(fluid.boundary.interface, {});
  const auto areas = std::exchange(fluid.boundary.interface_areas, {});
  for (const bool own : {true, false})
    for (std::size_t i = 0; i < whole.size(); ++i) {
      const InterfaceNode node{here.local(whole[i].fluid), wall.local(whole[i].wall), whole[i].clamped};
      if (node.fluid < 0 || (here.share().owned[node.fluid] != 0) != own) continue;
      fluid.boundary.interface.push_back(node);
      fluid.boundary.interface_areas.push_back(areas[i]);
      if (!own) ++fluid.interface_ghosts;
    }
}

template <class Element>
void restrict_wall(const PartRestriction& here, const PartOf<Element>& whole, WallParts<Element>& wall) {
  std::vector<int> cells;
  wall.part = here.part(whole, cells);
  wall.whole_cells.assign(cells.begin(), cells.end());
  wall.held = {restricted(wall.held.conditions, here), restricted(wall.held.frames, here)};
  wall.pressurised = here.facets(wall.pressurised);
  if (wall.frame && !wall.frame->fields.empty()) wall.frame->fields = restricted(wall.frame->fields, here);
  for (auto& [name, facets] : wall.supports) facets = here.facets(facets);
}

/// \param wall  of the wall; null: there is none
template <class Element>
void restrict_fluid(const PartRestriction& here, const PartOf<Element>& whole, const PartRestriction* wall,
                    FluidParts<Element>& fluid) {
  std::vector<int> cells;
  fluid.part = here.part(whole, cells);
  fluid.stiffness = of_cells(fluid.stiffness, cells);
  auto& boundary = fluid.boundary;
  boundary.open = restricted<Element>(boundary.open, fluid.part.nodes, here);
  boundary.velocity = restricted(boundary.velocity, here);
  boundary.mesh = restricted(boundary.mesh, here);
  boundary.mirrored = restricted(boundary.mirrored, here);
  boundary.frames = restricted(boundary.frames, here);
  if (wall) restrict_interface(here, *wall, fluid);
  for (Inflow& inflow : fluid.inflows) restrict_to<Element::components>(here, inflow);
}

}  // namespace

template <class Element>
SceneParts<Element> find_parts(const Case& setup, const MeshOf<Element>& mesh) {
  std::vector<int> wall_regions;
  if (setup.structure)
    for (const auto& [name, data] : setup.structure->layers) wall_regions.push_back(mesh.region_index(name));
  SceneParts<Element> scene;
  if (setup.structure) scene.wall = find_wall<Element>(setup, mesh, wall_regions);
  if (!setup.fluid) return scene;
  scene.fluid = find_fluid<Element>(setup, mesh, wall_regions, scene.wall ? &*scene.wall : nullptr);
  if (auto stuck = require_pressure_equations(setup, *scene.fluid); !stuck.empty())
    scene.remarks.push_back(std::move(stuck));
  return scene;
}

template <class Element>
WholeParts<Element> restrict_to(const MeshShare& share, SceneParts<Element>& scene) {
  using Part = PartOf<Element>;
  WholeParts<Element> whole;
  if (scene.wall) {
    whole.wall = std::make_unique<const Part>(std::move(scene.wall->part));
    whole.wall_here = std::make_unique<const PartRestriction>(*whole.wall, share);
    restrict_wall<Element>(*whole.wall_here, *whole.wall, *scene.wall);
  }
  if (scene.fluid) {
    whole.fluid = std::make_unique<const Part>(std::move(scene.fluid->part));
    whole.fluid_here = std::make_unique<const PartRestriction>(*whole.fluid, share);
    restrict_fluid<Element>(*whole.fluid_here, *whole.fluid, whole.wall_here.get(), *scene.fluid);
  }
  return whole;
}

#define FSI_INSTANTIATE(Element)                                                         \
  template SceneParts<Element> find_parts<Element>(const Case&, const MeshOf<Element>&); \
  template WholeParts<Element> restrict_to<Element>(const MeshShare&, SceneParts<Element>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
