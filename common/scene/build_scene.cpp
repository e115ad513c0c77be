#include "scene/build_scene.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/boundary.hpp"

namespace fsi {

template class FluidProblem<P1Tetrahedron>;
template class WallProblem<P1Tetrahedron>;

namespace {

using Facets = std::vector<TetrahedralMesh::Facet>;

Facets local_facets(const Submesh<3>& part, const Facets& facets) {
  Facets local;
  for (const auto& facet : facets) local.push_back(part.local(facet));
  return local;
}

const Facets& group(const TetrahedralMesh& mesh, const std::string& name) {
  static const Facets none;
  const auto* facets = mesh.facets(name);
  return facets ? *facets : none;
}

/// Where pressure acts on a wall without fluid: its interface with the fluid volume if the mesh has one, else the group
/// `inner`; normals out of the wall.
Facets inner_surface(const TetrahedralMesh& mesh, const std::vector<int>& wall_regions) {
  const int fluid = mesh.region_index("fluid");
  if (fluid < 0) return group(mesh, "inner");
  Facets facets = interface_facets(mesh, fluid, wall_regions);
  for (auto& facet : facets) std::swap(facet[1], facet[2]);
  return facets;
}

void mark(std::vector<char>& marks, const Submesh<3>& part, const Facets& facets) {
  for (const auto& facet : facets)
    for (int node : facet) marks[part.local_node[node]] = 1;
}

LayerMaterial layer_material(const MaterialData& data) {
  const double degree = std::acos(-1.0) / 180;
  if (data.material == "mooney-rivlin") return {MooneyRivlin{data.c10, data.c01}, 0};
  if (data.material == "artery") return {Artery{data.c10, data.k1, data.k2, data.fibre_scale}, data.alpha * degree};
  return {NeoHookean{data.c10}, 0};
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

}  // namespace

std::unique_ptr<Scene<P1Tetrahedron>> build_scene(const Case& setup, const TetrahedralMesh& mesh) {
  auto scene = std::make_unique<Scene<P1Tetrahedron>>();
  if (setup.time)
    scene->scheme = {setup.time->step, setup.time->newmark_beta, setup.time->newmark_gamma,
                     setup.time->predictor.value_or(1), 3};
  else
    scene->scheme.predictor = 1;

  const int fluid_region = setup.fluid ? mesh.region_index("fluid") : -1;
  std::vector<int> wall_regions;
  if (setup.structure)
    for (const auto& [name, data] : setup.structure->layers) wall_regions.push_back(mesh.region_index(name));
  const Facets interface =
      setup.fluid && setup.structure ? interface_facets(mesh, fluid_region, wall_regions) : Facets{};

  if (setup.structure) {
    auto part = submesh(mesh, wall_regions);
    scene->clamped.assign(part.nodes.size(), 0);
    mark(scene->clamped, part, group(mesh, "wall_ends"));
    std::vector<std::pair<int, LayerMaterial>> layers;
    for (const auto& [name, data] : setup.structure->layers)
      layers.push_back({mesh.region_index(name), layer_material(data)});
    Facets pressurised;
    if (setup.load) pressurised = local_facets(part, inner_surface(mesh, wall_regions));
    const auto& s = *setup.structure;
    scene->wall = std::make_unique<WallProblem<P1Tetrahedron>>(
        std::move(part), WallConstants{s.density, s.bulk_modulus, s.stabilisation}, layers, cylinder_axis(s),
        pressurised);
    scene->profile.count("structure elements", static_cast<std::int64_t>(scene->wall->part().cells.size()));
    for (const auto& layer : scene->wall->layers())
      if (!layer.fibres.empty())
        scene->profile.count("elements with fibres", static_cast<std::int64_t>(layer.packs.element_count()));
  }

  if (setup.fluid) {
    auto part = submesh(mesh, {fluid_region});
    const auto &inlet = group(mesh, "inlet"), &outlet = group(mesh, "outlet");
    // No slip on every boundary facet that is neither open nor interface; the rims of the open faces belong to the
    // wall.
    std::vector<char> open(part.nodes.size(), 0), wet(part.nodes.size(), 0);
    mark(open, part, inlet);
    mark(open, part, outlet);
    mark(wet, part, interface);
    Facets closed;
    {
      std::vector<std::array<int, 3>> known;
      for (const auto* facets : {&inlet, &outlet, &interface})
        for (auto facet : *facets) {
          std::sort(facet.begin(), facet.end());
          known.push_back(facet);
        }
      std::sort(known.begin(), known.end());
      for (const auto& facet : boundary_facets(mesh, {fluid_region})) {
        auto key = facet.nodes;
        std::sort(key.begin(), key.end());
        if (!std::binary_search(known.begin(), known.end(), key)) closed.push_back(facet.nodes);
      }
    }
    scene->no_slip.assign(part.nodes.size(), 0);
    mark(scene->no_slip, part, closed);
    scene->mesh_fixed.assign(part.nodes.size(), 0);
    for (std::size_t a = 0; a < part.nodes.size(); ++a) {
      if (open[a] || scene->no_slip[a]) scene->mesh_fixed[a] = 1;
      if (!wet[a]) continue;
      const int wall_node = scene->wall->part().local_node[part.mesh_node[a]];
      const bool clamped = scene->clamped[wall_node] != 0;
      if (clamped || scene->no_slip[a]) scene->no_slip[a] = scene->mesh_fixed[a] = 1;
      scene->interface.push_back({static_cast<int>(a), wall_node, clamped});
    }
    const AleFluid form{setup.fluid->density, setup.fluid->viscosity, scene->scheme.step, setup.fluid->grad_div};
    const auto local_inlet = local_facets(part, inlet), local_outlet = local_facets(part, outlet);
    scene->fluid = std::make_unique<FluidProblem<P1Tetrahedron>>(std::move(part), form, local_inlet, local_outlet);
    scene->profile.count("fluid elements", static_cast<std::int64_t>(scene->fluid->part().cells.size()));
  }

  scene->keep_constant_operators = setup.economy.constant_operators == "kept";
  if (scene->coupled()) scene->assemble_mesh_motion();
  return scene;
}

}  // namespace fsi
