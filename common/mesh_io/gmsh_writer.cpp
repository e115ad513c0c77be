#include "mesh_io/gmsh_writer.hpp"

#include <array>
#include <cassert>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh_io/gmsh_file.hpp"
#include "mesh_io/gmsh_session.hpp"
#include "mesh_io/temporary_mesh.hpp"

namespace fsi {

namespace {

/// gmsh's number of the simplex with that many dimensions and that order.
constexpr int gmsh_simplex(int dim, int order) {
  constexpr int numbers[][2] = {{1, 8}, {2, 9}, {4, 11}};
  return numbers[dim - 1][order - 1];
}

/// Adds node tags in gmsh's order: vertices first, then the middles of the edges. Its quadratic tetrahedron has the
/// last two edges the other way round.
template <std::size_t Nodes>
void add_tags(const std::array<int, Nodes>& simplex, std::vector<std::size_t>& tags) {
  for (const int node : simplex) tags.push_back(node + 1);
  if constexpr (Nodes == nodes_of_simplex(3, 2)) std::swap(tags[tags.size() - 1], tags[tags.size() - 2]);
}

template <int Dim, int Order>
void fill_model(const SimplexMesh<Dim, Order>& mesh, const GmshFormat& format) {
  assert(mesh.cell_region.size() == mesh.cells.size());
  const int regions = static_cast<int>(mesh.regions.size()), groups = static_cast<int>(mesh.facet_groups.size());

  std::vector<std::size_t> node_tags(mesh.nodes.size());
  std::vector<double> coordinates;
  coordinates.reserve(3 * mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    node_tags[i] = i + 1;
    coordinates.insert(coordinates.end(), mesh.nodes[i].begin(), mesh.nodes[i].end());
  }

  gmsh::model::add("mesh");
  for (int g = 0; g < groups; ++g) gmsh::model::addDiscreteEntity(Dim - 1, g + 1);
  for (int r = 0; r < regions; ++r) gmsh::model::addDiscreteEntity(Dim, r + 1);
  gmsh::model::mesh::addNodes(Dim, 1, node_tags, coordinates);

  const auto add_physical_group = [&](int dimension, int entity, const std::string& name, int number) {
    const int tag = format.tags.empty() ? number : format.tags.at({dimension, name});
    gmsh::model::addPhysicalGroup(dimension, {entity}, tag);
    gmsh::model::setPhysicalName(dimension, tag, name);
  };
  std::size_t next_element = 1;
  const auto add_elements = [&](int entity, int type, const std::vector<std::size_t>& nodes, std::size_t count) {
    std::vector<std::size_t> tags(count);
    for (auto& tag : tags) tag = next_element++;
    gmsh::model::mesh::addElementsByType(entity, type, tags, nodes);
  };
  for (int g = 0; g < groups; ++g) {
    std::vector<std::size_t> nodes;
    for (const auto& facet : mesh.facet_groups[g].facets) add_tags(facet, nodes);
    add_elements(g + 1, gmsh_simplex(Dim - 1, Order), nodes, mesh.facet_groups[g].facets.size());
    add_physical_group(Dim - 1, g + 1, mesh.facet_groups[g].name, g + 1);
  }
  for (int r = 0; r < regions; ++r) {
    std::vector<std::size_t> nodes;
    std::size_t count = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      if (mesh.cell_region[c] != r) continue;
      ++count;
      add_tags(mesh.cells[c], nodes);
    }
    add_elements(r + 1, gmsh_simplex(Dim, Order), nodes, count);
    add_physical_group(Dim, r + 1, mesh.regions[r], groups + r + 1);
  }
}

/// How many elements of a type a file has.
std::size_t elements_in(const std::filesystem::path& path, int type) {
  std::size_t count = 0;
  for (const auto& block : parse_gmsh(path).blocks)
    if (block.type == type) count += block.tags.size();
  return count;
}

}  // namespace

template <int Dim, int Order>
void write_gmsh(const SimplexMesh<Dim, Order>& mesh, const std::filesystem::path& file, const GmshFormat& format) {
  if (format.version != "4.1" && format.version != "2.2")
    throw InputError(file.string(), "format", "there is no writer for version '" + format.version + "'",
                     "use 4.1 or 2.2");
  const TemporaryMesh temporary(regular_output_file(file));
  std::string failure;
  {
    const GmshSession session;
    try {
      fill_model(mesh, format);
      gmsh::option::setNumber("Mesh.MshFileVersion", format.version == "4.1" ? 4.1 : 2.2);
      gmsh::option::setNumber("Mesh.Binary", format.binary ? 1 : 0);
      gmsh::write(temporary.path().string());
    } catch (...) {
      failure = GmshSession::last_error();
    }
  }
  if (!failure.empty())
    throw InputError(file.string(), "", "the gmsh library cannot write it: " + failure, "choose another place");
  // The library reports a full disk on its console only, so look at what arrived.
  if (elements_in(temporary.path(), gmsh_simplex(Dim, Order)) != mesh.cells.size())
    throw InputError(file.string(), "", "was not written completely", "check the space on the disk");
  temporary.move_into_place();
}

#define INSTANTIATE(Dim, Order) \
  template void write_gmsh(const SimplexMesh<Dim, Order>&, const std::filesystem::path&, const GmshFormat&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
