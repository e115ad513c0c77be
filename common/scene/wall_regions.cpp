#include "scene/wall_regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/error.hpp"
#include "fields/field_units.hpp"
#include "fields/region_shape.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

template <int Dim, int Order>
Point centre_of(const SimplexMesh<Dim, Order>& mesh, std::size_t cell) {
  Point centre{0, 0, 0};
  for (int a = 0; a <= Dim; ++a) centre = centre + (1.0 / (Dim + 1)) * mesh.nodes[mesh.cells[cell][a]];
  return centre;
}

std::string key_of(const RegionData& region) {
  return "structure.region." + region.name;
}

/// Points of the region's file, and the nodes of the mesh, that would meet if the file were in another unit; else empty.
template <int Dim, int Order>
std::string slip_of(const RegionShape& shape, const SimplexMesh<Dim, Order>& mesh) {
  std::vector<Point> points;
  if (shape.line) points = *shape.line;
  if (shape.surface) points = shape.surface->nodes;
  const auto slip = length_slip(points, mesh.nodes);
  return slip ? fmt::format("its file may be in {}: give length_unit = \"{}\" beside file; else ", slip->unit,
                            slip->unit)
              : "";
}

}  // namespace

template <int Dim, int Order>
void cut_out_regions(const Case& setup, SimplexMesh<Dim, Order>& mesh, std::vector<std::string>& remarks) {
  if (!setup.structure) return;
  const StructureData& structure = *setup.structure;
  for (std::size_t r = 0; r < structure.regions.size(); ++r) {
    const RegionData& region = structure.regions[r];
    if (region.transition > 0) continue;
    const RegionDistance outside(region.shape, 0);
    for (const auto& layer : region.layers) {
      const std::string name = layer + "/" + region.name;
      const auto index = static_cast<int>(mesh.regions.size());
      mesh.regions.push_back(name);
      std::size_t count = 0;
      std::map<std::string, std::size_t> taken;  // of earlier regions
      for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        const std::string& before = mesh.regions[static_cast<std::size_t>(mesh.cell_region[c])];
        if (before != layer && before.rfind(layer + "/", 0) != 0) continue;
        if (!(outside(centre_of(mesh, c)) <= 0)) continue;
        if (before != layer) ++taken[before];
        mesh.cell_region[c] = index;
        ++count;
      }
      if (count == 0)
        throw InputError(setup.path.string(), key_of(region),
                         fmt::format("no element of {} has its centre in it", layer),
                         slip_of(region.shape, mesh) +
                             "check its place and size in mm, or give layers = [...], those that it is in");
      std::string said = fmt::format("{}: {} elements of {} are {}", key_of(region), count, layer, name);
      for (const auto& [other, number] : taken) said += fmt::format(", {} of them taken from {}", number, other);
      remarks.push_back(std::move(said));
    }
  }
  for (const auto& [name, layer] : structure.layers) {
    const int index = mesh.region_index(name);
    if (std::find(mesh.cell_region.begin(), mesh.cell_region.end(), index) != mesh.cell_region.end()) continue;
    if (layer.part_of.empty() && index < 0) continue;  // reported where layers are looked up
    throw InputError(setup.path.string(), "structure.region", fmt::format("later regions leave no element to {}", name),
                     layer.part_of.empty() ? "leave some, or give the volume as a layer the constants that it has"
                                           : "remove that region, or give it a higher order");
  }
}

#define INSTANTIATE(Dim, Order) \
  template void cut_out_regions(const Case&, SimplexMesh<Dim, Order>&, std::vector<std::string>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
