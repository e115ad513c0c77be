#include "mesher/lumen_volume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/facets.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"
#include "mesh_io/gmsh_session.hpp"

namespace fsi {

namespace {

using Facet = TetrahedralMesh::Facet;
using Edge = std::pair<int, int>;
constexpr int triangle_type = 2, tetrahedron_type = 4;  // gmsh's numbers

/// The nodes of the model in a mesh, by their tags.
std::map<std::size_t, int> take_nodes(TetrahedralMesh& mesh) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, unused;
  gmsh::model::mesh::getNodes(tags, coordinates, unused);
  std::map<std::size_t, int> number;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    number[tags[i]] = static_cast<int>(i);
    mesh.nodes.push_back({coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]});
  }
  return number;
}

template <std::size_t nodes>
std::vector<std::array<int, nodes>> take_elements(int type, int entity, const std::map<std::size_t, int>& number) {
  std::vector<std::size_t> tags, node_tags;
  gmsh::model::mesh::getElementsByType(type, tags, node_tags, entity);
  std::vector<std::array<int, nodes>> elements(tags.size());
  for (std::size_t e = 0; e < tags.size(); ++e)
    for (std::size_t k = 0; k < nodes; ++k) elements[e][k] = number.at(node_tags[nodes * e + k]);
  return elements;
}

/// Each edge must have two triangles.
void require_closed(const std::string& file, const TetrahedralMesh& mesh, const std::vector<Facet>& triangles) {
  std::map<Edge, int> uses;
  for (const auto& t : triangles)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  std::map<int, std::vector<int>> free;
  for (const auto& [edge, count] : uses) {
    if (count > 2)
      throw InputError(file, "edge at " + place_of(mesh.nodes[edge.first]),
                       fmt::format("{} triangles meet there", count), "mend the surface: two must meet at each edge");
    if (count == 1) {
      free[edge.first].push_back(edge.second);
      free[edge.second].push_back(edge.first);
    }
  }
  if (free.empty()) return;
  int holes = 0;
  std::set<int> seen;
  Point centre{0, 0, 0};
  for (const auto& [start, unused] : free) {
    if (!seen.insert(start).second) continue;
    std::vector<int> loop{start};
    for (std::size_t i = 0; i < loop.size(); ++i)
      for (const int next : free[loop[i]])
        if (seen.insert(next).second) loop.push_back(next);
    if (++holes > 1) continue;
    for (const int node : loop) centre = centre + (1.0 / static_cast<double>(loop.size())) * mesh.nodes[node];
  }
  throw InputError(file, "surface",
                   fmt::format("has {} hole{}, one around {}", holes, holes > 1 ? "s" : "", place_of(centre)),
                   "close it: the openings of the lumen need flat caps");
}

/// Facets of the groups as facets of the cells, normals outward.
void orient(TetrahedralMesh& mesh) {
  std::map<FacetKey<3>, Facet> outward;
  for (const auto& facet : boundary_facets(mesh)) outward[facet_key<3>(facet.nodes)] = facet.nodes;
  for (auto& group : mesh.facet_groups)
    for (auto& facet : group.facets) facet = outward.at(facet_key<3>(facet));
}

/// Fills what the surfaces of gmsh's model enclose. \throws InputError saying it of `file`
void generate_volume(const std::string& file) {
  std::string failure;
  try {
    gmsh::vectorpair surfaces;
    gmsh::model::getEntities(surfaces, 2);
    std::vector<int> tags;
    for (const auto& [dimension, tag] : surfaces) tags.push_back(tag);
    gmsh::model::geo::addVolume({gmsh::model::geo::addSurfaceLoop(tags)});
    gmsh::model::geo::synchronize();
    gmsh::model::mesh::generate(3);
  } catch (...) {
    failure = GmshSession::last_error();
  }
  if (!failure.empty())
    throw InputError(file, "surface", "cannot be filled: " + failure, "mend it: no triangle may cut another one");
}

/// The filled model as a mesh, with its physical surfaces. \throws InputError saying of `file` that it has no volume
TetrahedralMesh take_mesh(const std::string& file) {
  TetrahedralMesh mesh;
  const auto number = take_nodes(mesh);
  mesh.cells = take_elements<4>(tetrahedron_type, -1, number);
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, 2);
  for (const auto& [dimension, tag] : groups) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
    TetrahedralMesh::FacetGroup group{name, {}};
    for (const int entity : entities) {
      const auto part = take_elements<3>(triangle_type, entity, number);
      group.facets.insert(group.facets.end(), part.begin(), part.end());
    }
    if (!name.empty()) mesh.facet_groups.push_back(std::move(group));
  }
  if (mesh.cells.empty())
    throw InputError(file, "surface", "encloses no volume", "mend it: its triangles must bound one lumen");
  mesh.regions = {group::fluid};
  mesh.cell_region.assign(mesh.cells.size(), 0);
  for (auto& cell : mesh.cells)
    if (tetrahedron_volume(mesh.nodes[cell[0]], mesh.nodes[cell[1]], mesh.nodes[cell[2]], mesh.nodes[cell[3]]) < 0)
      std::swap(cell[2], cell[3]);
  orient(mesh);
  return mesh;
}

/// One of the model's surfaces, of triangles that are there. \param name  of its physical group; none when empty
void add_surface(const std::string& name, const std::vector<Facet>& triangles, const std::vector<double>& coordinates) {
  const int tag = gmsh::model::addDiscreteEntity(2);
  if (!coordinates.empty()) {
    std::vector<std::size_t> nodes(coordinates.size() / 3);
    std::iota(nodes.begin(), nodes.end(), std::size_t{1});
    gmsh::model::mesh::addNodes(2, tag, nodes, coordinates);
  }
  std::vector<std::size_t> corners;
  for (const auto& t : triangles)
    for (const int node : t) corners.push_back(static_cast<std::size_t>(node) + 1);
  gmsh::model::mesh::addElementsByType(tag, triangle_type, {}, corners);
  if (!name.empty()) gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {tag}), name);
}

}  // namespace

TetrahedralMesh fill_surface(const std::vector<Point>& nodes, const std::vector<TetrahedralMesh::FacetGroup>& surfaces,
                             const std::string& file) {
  const GmshSession session;
  gmsh::option::setNumber("General.NumThreads", 1);
  gmsh::model::add("lumen");
  std::vector<double> coordinates;
  for (const Point& x : nodes) coordinates.insert(coordinates.end(), x.begin(), x.end());
  for (const auto& surface : surfaces) {
    add_surface(surface.name, surface.facets, coordinates);
    coordinates.clear();
  }
  generate_volume(file);
  return take_mesh(file);
}

TetrahedralMesh fill_lumen(const std::filesystem::path& surface, const std::vector<FlatPart>& openings) {
  const std::string file = surface.string();
  if (std::error_code error; !std::filesystem::is_regular_file(surface, error))
    throw InputError(file, "", "no such file", "give a surface of triangles, .stl or .msh");
  TetrahedralMesh mesh;
  std::string failure;
  {
    const GmshSession session;
    try {
      gmsh::option::setNumber("General.NumThreads", 1);
      gmsh::merge(file);
    } catch (...) {
      failure = GmshSession::last_error();
    }
    if (!failure.empty()) throw InputError(file, "", "gmsh cannot read it: " + failure, "give a surface, .stl or .msh");
    {
      TetrahedralMesh points;
      const auto number = take_nodes(points);
      const auto triangles = take_elements<3>(triangle_type, -1, number);
      if (triangles.empty())
        throw InputError(file, "", "holds no triangles", "give a surface of triangles, .stl or .msh");
      require_closed(file, points, triangles);
    }
    generate_volume(file);
    mesh = take_mesh(file);
  }
  name_flat_parts(mesh, openings);
  if (mesh.facet_groups.empty())
    throw InputError("fsi-mesh", "--opening", "is not given, and the surface has no names",
                     "name each: " + places_of_flat_parts(mesh));
  return mesh;
}

}  // namespace fsi
