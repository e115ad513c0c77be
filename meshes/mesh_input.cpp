#include "meshes/mesh_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "mesh_io/gmsh_reader.hpp"
#include "meshes/mesh_report.hpp"
#include "run/program.hpp"

namespace fsi {

namespace {

/// Refuses scripts: their shape can be meshed again.
void require_mesh(const std::string& file) {
  if (std::filesystem::path(file).extension() == ".geo")
    throw InputError(file, "", "is a script, no mesh",
                     "make a finer mesh of it by its constant for the size: fsi-mesh geo " + printable(file) +
                         " -o FILE.msh --set NAME=SIZE");
}

/// Sections of axisymmetric bodies are written in the plane y = 0, all others drawn in the plane z = 0.
TriangleGeometry plane_of(const GmshFile& file) {
  Point most{0, 0, 0};
  for (const auto& x : file.nodes)
    for (int d = 0; d < 3; ++d) most[d] = std::max(most[d], std::abs(x[d]));
  return most[1] < most[2] ? TriangleGeometry::axisymmetric : TriangleGeometry::plane;
}

std::vector<std::string> regions_of(const GmshFile& file, int dimension) {
  std::vector<std::string> regions;
  for (const auto& name : file.names)
    if (name.dimension == dimension && std::find(regions.begin(), regions.end(), name.name) == regions.end())
      regions.push_back(name.name);
  return regions;
}

std::size_t cells_in(const GmshFile& file, int dimension) {
  std::size_t cells = 0;
  for (const auto& block : file.blocks)
    if (gmsh_type(block.type)->dimension == dimension) cells += block.tags.size();
  return cells;
}

}  // namespace

MeshLayout mesh_layout(const std::string& file) {
  require_mesh(file);
  MeshLayout layout;
  const GmshFile parsed = parse_gmsh(file);
  layout.dimension = std::max(2, gmsh_dimension(parsed));  // the reader says what is missing in a file without surfaces
  layout.order = gmsh_order(parsed, layout.dimension);
  layout.regions = regions_of(parsed, layout.dimension);
  if (layout.dimension == 2) layout.plane = plane_of(parsed);
  for (const auto& name : parsed.names) layout.tags.try_emplace({name.dimension, name.name}, name.tag);
  layout.cells = cells_in(parsed, layout.dimension);
  if (layout.regions.empty())
    throw InputError(file, "$PhysicalNames", "the file names no physical volume and no physical surface",
                     "name the parts in gmsh, e.g. Physical Volume(\"fluid\") = {1};");
  return layout;
}

ReadMesh read_mesh_file(const std::string& file) {
  MeshLayout layout = mesh_layout(file);
  ReadMesh result{{}, layout.plane, std::move(layout.tags)};
  result.mesh = read_gmsh(file, layout.regions, layout.dimension, layout.order, layout.plane);
  result.left_out = layout.cells - std::visit([](const auto& mesh) { return mesh.cells.size(); }, result.mesh);
  return result;
}

void warn_of_astray(const std::string& file, const std::string& surface, const std::string& astray) {
  if (!astray.empty()) warn(mesh_program, fmt::format("{}: {}: {} and left out", printable(file), surface, astray));
}

void warn_of_left_out(const std::string& file, const ReadMesh& mesh) {
  if (mesh.left_out > 0)
    warn(mesh_program,
         fmt::format("{}: {} cells in no physical group with a name are left out", printable(file), mesh.left_out));
  std::visit([&](const auto& read) { warn_of_astray(file, read); }, mesh.mesh);
}

}  // namespace fsi
