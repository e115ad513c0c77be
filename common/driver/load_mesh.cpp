#include "driver/load_mesh.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/names.hpp"
#include "mesh/artery_generator.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/renumber.hpp"

namespace fsi {

namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

TetrahedralMesh read_or_make(const Case& setup, const std::vector<std::string>& layers, SceneMeshNeeds& needs) {
  std::vector<std::string> available;
  TetrahedralMesh made;
  if (setup.mesh.file.empty()) {
    made = generate_artery(artery_level(setup.mesh.level));
    available = made.regions;
  } else {
    available = gmsh_volumes(setup.mesh.file);
  }
  for (const auto& layer : layers)
    if (!contains(available, layer))
      throw InputError(setup.path.string(), "structure.layers." + layer,
                       "the mesh " + mesh_name(setup) + " has no such volume", "its volumes are " + one_of(available));
  auto wanted = layers;
  // Under a wall alone the fluid volume, where there is one, shows the wall's inner face.
  const bool fluid_shows_inner_face = !setup.fluid && setup.load && contains(available, "fluid");
  if (setup.fluid || fluid_shows_inner_face) wanted.push_back("fluid");
  needs.inner_surface = !setup.fluid && setup.load && !fluid_shows_inner_face;
  if (!setup.mesh.file.empty()) return read_gmsh(setup.mesh.file, wanted);
  return made;
}

}  // namespace

std::string mesh_name(const Case& setup) {
  return setup.mesh.file.empty() ? "level " + setup.mesh.level : setup.mesh.file.string();
}

TetrahedralMesh load_mesh(const Case& setup) {
  SceneMeshNeeds needs;
  needs.fluid = setup.fluid.has_value();
  needs.inlet = needs.outlet = needs.fluid;
  if (setup.structure)
    for (const auto& [name, data] : setup.structure->layers) needs.layers.push_back(name);
  const TetrahedralMesh mesh = read_or_make(setup, needs.layers, needs);
  check_scene_mesh(mesh, needs, mesh_name(setup));
  // Made meshes come in a good order already.
  TetrahedralMesh ordered = renumbered(mesh, reverse_cuthill_mckee(mesh));
  return bandwidth(ordered) < bandwidth(mesh) ? ordered : mesh;
}

std::string hash_of_mesh(const TetrahedralMesh& mesh) {
  Fnv1a hash;
  hash.add(mesh.nodes.data(), mesh.nodes.size() * sizeof(mesh.nodes[0]));
  hash.add(mesh.cells.data(), mesh.cells.size() * sizeof(mesh.cells[0]));
  for (int region : mesh.cell_region) hash.add(mesh.regions[region]);
  return hash.hex();
}

}  // namespace fsi
