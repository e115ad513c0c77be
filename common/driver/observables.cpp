#include "driver/observables.hpp"

#include <algorithm>

#include "mesh/boundary.hpp"
#include "mesh/group_names.hpp"

namespace fsi {

namespace {
constexpr int line_points = 181;
}

Observables::Observables(const Case& setup, const TetrahedralMesh& mesh, const Scene<P1Tetrahedron>& scene)
    : scene_(scene) {
  if (setup.structure) axis_ = {setup.structure->axis_origin, setup.structure->axis_direction};
  const int fluid_region = mesh.region_index("fluid");
  if (scene.fluid) {
    const auto &inlet = *mesh.facets("inlet"), &outlet = *mesh.facets("outlet");
    centre_z_ =
        evenly_spaced(axial_position(mesh.nodes, inlet, axis_), axial_position(mesh.nodes, outlet, axis_), line_points);
    centre_line_ = sample_in_cells(mesh, fluid_region, points_on_axis(axis_, centre_z_));
    for (auto& sample : centre_line_)
      for (int& node : sample.nodes) node = scene.fluid->part().local_node[node];
  }
  if (scene.wall) {
    std::vector<int> wall_regions;
    for (const auto& [name, data] : setup.structure->layers) wall_regions.push_back(mesh.region_index(name));
    const auto* inner = mesh.facets("inner");
    const auto surface = fluid_region >= 0 ? interface_facets(mesh, fluid_region, wall_regions)
                                           : (inner ? *inner : std::vector<TetrahedralMesh::Facet>{});
    if (surface.empty()) return;
    const AxisFrame frame(axis_);
    double first = frame.axial(mesh.nodes[surface[0][0]]), last = first;
    for (const auto& facet : surface)
      for (int node : facet) {
        first = std::min(first, frame.axial(mesh.nodes[node]));
        last = std::max(last, frame.axial(mesh.nodes[node]));
      }
    wall_z_ = evenly_spaced(first, last, line_points);
    wall_line_ = wall_samples(mesh.nodes, surface, axis_, wall_z_, angles);
    for (auto& sample : wall_line_)
      for (int& node : sample.nodes) node = scene.wall->part().local_node[node];
  }
}

void Observables::write(const State& state, ResultFolder& folder) const {
  constexpr int n = P1Tetrahedron::components;
  using Mixed = MixedLayout<n>;
  if (!centre_line_.empty()) {
    std::vector<double> pressure(centre_line_.size(), 0.0);
    for (std::size_t i = 0; i < centre_line_.size(); ++i)
      for (int a = 0; a < 4; ++a)
        pressure[i] += centre_line_[i].weights[a] * state.now.fluid[Mixed::scalar(centre_line_[i].nodes[a])];
    folder.write_centerline(state.time, centre_z_, pressure);
    const auto &inlet = *scene_.fluid->open_boundary(group::inlet),
               &outlet = *scene_.fluid->open_boundary(group::outlet);
    const auto& fluid = state.now.fluid;
    folder.write_flow(state.time, {-inlet.outflow(fluid), outlet.outflow(fluid), inlet.mean_pressure(fluid),
                                   outlet.mean_pressure(fluid)});
  }
  if (!wall_line_.empty()) {
    const AxisFrame frame(axis_);
    std::vector<double> radial(wall_z_.size(), 0.0), axial(wall_z_.size(), 0.0);
    for (std::size_t i = 0; i < wall_line_.size(); ++i)
      for (int a = 0; a < 3; ++a)
        for (int k = 0; k < n; ++k) {
          const double d = wall_line_[i].weights[a] / angles * state.now.wall[Mixed::vector(wall_line_[i].nodes[a], k)];
          radial[i / angles] += d * wall_line_[i].direction[k];
          axial[i / angles] += d * frame.along[k];
        }
    folder.write_wall(state.time, wall_z_, radial, axial);
  }
}

}  // namespace fsi
