#include "scene/build_scene.hpp"

#include <cmath>
#include <utility>

#include "mesh/boundary.hpp"
#include "mesh/group_names.hpp"
#include "scene/boundary_conditions.hpp"
#include "time/euler_newmark.hpp"

namespace fsi {

namespace {

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
  constexpr int n = P1Tetrahedron::components;
  using Facets = std::vector<TetrahedralMesh::Facet>;
  auto scene = std::make_unique<Scene<P1Tetrahedron>>();
  if (setup.time) {
    scene->integrator =
        std::make_unique<EulerNewmark<n>>(NewmarkParameters{setup.time->newmark_beta, setup.time->newmark_gamma});
    scene->predictor = setup.time->predictor.value_or(1);
  }

  const int fluid_region = setup.fluid ? mesh.region_index(group::fluid) : -1;
  std::vector<int> wall_regions;
  if (setup.structure)
    for (const auto& [name, data] : setup.structure->layers) wall_regions.push_back(mesh.region_index(name));

  if (setup.structure) {
    auto part = submesh(mesh, wall_regions);
    scene->wall_conditions = wall_conditions(mesh, part);
    std::vector<std::pair<int, Material>> layers;
    for (const auto& [name, data] : setup.structure->layers)
      layers.push_back({mesh.region_index(name), make_material(data.material, data.values)});
    const Facets pressurised = setup.load ? in_part(part, inner_surface(mesh, wall_regions)) : Facets{};
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
    const Facets interface = setup.structure ? interface_facets(mesh, fluid_region, wall_regions) : Facets{};
    FluidBoundary boundary =
        fluid_boundary(openings_of(setup), mesh, part, interface, scene->wall ? &scene->wall->part() : nullptr,
                       scene->wall ? &scene->wall_conditions : nullptr);
    scene->velocity_conditions = std::move(boundary.velocity);
    scene->mesh_conditions = std::move(boundary.mesh);
    scene->interface = std::move(boundary.interface);
    const AleFluid form{setup.fluid->density, setup.fluid->viscosity, setup.fluid->grad_div};
    scene->fluid = std::make_unique<FluidProblem<P1Tetrahedron>>(std::move(part), form, std::move(boundary.open));
    scene->profile.count("fluid elements", static_cast<std::int64_t>(scene->fluid->part().cells.size()));
  }

  scene->keep_constant_operators = setup.economy.keep_constant_operators;
  if (scene->coupled()) scene->assemble_mesh_motion();
  return scene;
}

}  // namespace fsi
