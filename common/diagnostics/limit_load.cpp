#include "diagnostics/limit_load.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/material.hpp"
#include "mesh/axis.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

/// A layer measured as if it were a tube.
struct TubeLayer {
  double inner = std::numeric_limits<double>::infinity(), outer = 0;  ///< mm
  double first = std::numeric_limits<double>::infinity(), last = -first;
  double volume = 0;  ///< mm^3

  /// Whether it fills the tube between its radii but for what flat faces cut off.
  bool is_tube() const {
    constexpr double pi = 3.14159265358979323846, cut_off = 0.15;
    const double whole = pi * (outer * outer - inner * inner) * (last - first);
    return inner > 0 && std::abs(volume - whole) <= cut_off * whole;
  }
};

TubeLayer measure(const TetrahedralMesh& mesh, int region, const AxisFrame& frame) {
  TubeLayer layer;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    if (mesh.cell_region[c] != region) continue;
    const auto& cell = mesh.cells[c];
    layer.volume +=
        tetrahedron_volume(mesh.nodes[cell[0]], mesh.nodes[cell[1]], mesh.nodes[cell[2]], mesh.nodes[cell[3]]);
    for (const int node : cell) {
      const double radius = frame.radius(mesh.nodes[node]), along = frame.axial(mesh.nodes[node]);
      layer.inner = std::min(layer.inner, radius);
      layer.outer = std::max(layer.outer, radius);
      layer.first = std::min(layer.first, along);
      layer.last = std::max(layer.last, along);
    }
  }
  return layer;
}

}  // namespace

std::optional<double> tube_limit_load(const StructureData& wall, const TetrahedralMesh& mesh) {
  const AxisFrame frame({wall.axis_origin, wall.axis_direction});
  double limit = 0;
  for (const auto& [name, data] : wall.layers) {
    const auto modulus = inflation_modulus(make_material(data.material, data.values));
    if (!modulus) return std::nullopt;
    const TubeLayer layer = measure(mesh, mesh.region_index(name), frame);
    if (!layer.is_tube()) return std::nullopt;
    limit += *modulus * std::log(layer.outer / layer.inner);
  }
  return limit;
}

}  // namespace fsi
