#include "run/load_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "base/names.hpp"
#include "case/case_hash.hpp"
#include "fem/elements.hpp"
#include "fluid/fluid_problem.hpp"
#include "host/available_memory.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/group_names.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/mesh_hash.hpp"
#include "mesh/mesh_share.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "mesh/renumber.hpp"
#include "mesh/wall_faces.hpp"
#include "mesh_io/gmsh_reader.hpp"
#include "mesher/artery/curved_edges.hpp"
#include "mesher/artery/recommended_meshes.hpp"
#include "mesher/artery_generator.hpp"
#include "observers/field_output.hpp"
#include "observers/observation_points.hpp"
#include "observers/requested_samples.hpp"
#include "observers/shared_samples.hpp"
#include "run/mesh_units.hpp"
#include "run/prestress.hpp"
#include "scene/boundary_conditions.hpp"
#include "scene/build_scene.hpp"
#include "scene/closed_surfaces.hpp"
#include "scene/opening_pieces.hpp"
#include "scene/required_openings.hpp"
#include "scene/support_needs.hpp"
#include "scene/wall_regions.hpp"
#include "wall/wall_problem.hpp"

namespace fsi {

namespace {

/// What messages and summaries call the mesh: its file, "level coarse", or "recommended for 3%".
std::string mesh_name(const Case& setup) {
  if (!setup.mesh.file.empty()) return setup.mesh.file.string();
  return setup.mesh.error > 0
             ? fmt::format("recommended for {}% of {} waves", setup.mesh.error, wave_kinds().name_of(setup.mesh.waves))
             : "level " + setup.mesh.level;
}

/// The file that a message about the mesh names: its own, or the case that it is made for.
std::string mesh_source(const Case& setup) {
  return setup.mesh.file.empty() ? setup.path.string() : setup.mesh.file.string();
}

template <class Element>
constexpr TriangleGeometry triangle_geometry =
    Element::axisymmetric ? TriangleGeometry::axisymmetric : TriangleGeometry::plane;

/// The cells of the mesh recommended for an element and `mesh.error`.
template <class Element>
ArteryCells recommended_cells(const Case& setup) {
  return recommended_mesh(Element::order == 1 ? "p1" : "p2p1", Element::axisymmetric, setup.mesh.waves,
                          setup.mesh.error, {setup.path.string(), "element", "mesh.error"})
      .cells;
}

/// The artery on demand for an element, by level or error: straight tubes and their meridian sections only.
template <class Element>
MeshOf<Element> make_artery(const Case& setup) {
  const bool by_error = setup.mesh.error > 0;
  const ArteryOptions sizes = by_error ? ArteryOptions() : artery_level(setup.mesh.level);
  if constexpr (Element::dim == 3) {
    TetrahedralMesh tube =
        by_error ? generate_artery(sizes, recommended_cells<Element>(setup)) : generate_artery(sizes);
    if constexpr (Element::order == 1)
      return tube;
    else
      return with_curved_edges(tube, sizes.inner_radius);
  }
  if constexpr (Element::axisymmetric) {
    TriangleMesh section =
        generate_artery_section(sizes, by_error ? recommended_cells<Element>(setup) : artery_cells(sizes));
    if constexpr (Element::order == 1)
      return section;
    else
      return with_mid_edge_nodes(section);
  }
  throw InputError(setup.path.string(), by_error ? "mesh.error" : "mesh.level",
                   "makes tubes, which a plane scene cannot hold", "give mesh.file, or geometry = \"axisymmetric\"");
}

template <class Element>
MeshOf<Element> read_or_make(const Case& setup, const std::vector<std::string>& layers, SceneMeshNeeds& needs) {
  std::vector<std::string> available;
  MeshOf<Element> made;
  if (setup.mesh.file.empty()) {
    made = make_artery<Element>(setup);
    available = made.regions;
  } else {
    if (std::error_code error; !std::filesystem::exists(setup.mesh.file, error))
      throw InputError(setup.path.string(), "mesh.file", "there is no file " + setup.mesh.file.string(),
                       "check the path, or make one: fsi-mesh artery --level coarse -o FILE.msh");
    available = gmsh_regions(setup.mesh.file, Element::dim);
    const int dimension = gmsh_dimension(setup.mesh.file);
    if (dimension > Element::dim || available.empty())
      throw InputError(
          setup.mesh.file.string(), "geometry",
          fmt::format("this is a mesh of {} dimensions, the case's scene one of {}", dimension, Element::dim),
          dimension == 2 ? "set geometry = \"axisymmetric\" or \"plane\" in the case file"
                         : "give a mesh of triangles, or leave geometry out of the case file");
  }
  for (const auto& layer : layers)
    if (!contains(available, layer))
      throw InputError(setup.path.string(), "structure.layers." + layer,
                       "the mesh " + mesh_name(setup) + " has no such volume", "its volumes are " + one_of(available));
  if (!layers.empty())
    for (const auto& volume : available)
      if (volume != group::fluid && !contains(layers, volume)) needs.left_out.push_back(volume);
  auto wanted = layers;
  // Under a wall alone the fluid volume, where there is one, shows the wall's inner face.
  const bool fluid_shows_inner_face = !setup.fluid && (setup.load || setup.prestress) && contains(available, "fluid");
  if (setup.fluid || fluid_shows_inner_face) wanted.push_back("fluid");
  needs.inner_surface = !setup.fluid && (setup.load || setup.prestress) && !fluid_shows_inner_face;
  if (!setup.mesh.file.empty())
    return read_gmsh<Element::dim, Element::order>(setup.mesh.file, wanted, triangle_geometry<Element>);
  return made;
}

/// Names of its groups of facets that are not empty.
template <class Mesh>
std::vector<std::string> surfaces_of(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const auto& group : mesh.facet_groups)
    if (!group.facets.empty()) names.push_back(group.name);
  return names;
}

/// The mesh of a case, checked against what the scene needs and renumbered (reverse Cuthill-McKee). Volumes that the
/// scene does not need are left out, save `fluid` under a wall alone: its interface is where the pressure acts.
/// \param remarks  lines for the log are added to it \param notices  for the user
template <class Element>
MeshOf<Element> load_mesh(const Case& setup, std::vector<std::string>& remarks, std::vector<std::string>& notices) {
  SceneMeshNeeds needs;
  needs.fluid = setup.fluid.has_value();
  const bool listed = !setup.openings.empty() || is_closed(setup);
  if (!listed)
    for (const auto& opening : openings_of(setup))
      (opening.surface == group::inlet ? needs.inlet : needs.outlet) = true;
  needs.geometry = triangle_geometry<Element>;
  needs.at_rest = setup.static_load || (setup.prestress && setup.prestress->file.empty());
  if (setup.structure)
    for (const auto& [name, data] : setup.structure->layers)
      if (data.part_of.empty()) needs.layers.push_back(name);
  auto mesh = read_or_make<Element>(setup, needs.layers, needs);
  cut_out_regions(setup, mesh, remarks);
  if (setup.structure)
    for (const auto& [name, data] : setup.structure->layers)
      if (!data.part_of.empty()) needs.layers.push_back(name);
  if (listed) needs.openings = required_openings(setup, surfaces_of(mesh), mesh_name(setup));
  need_supports(setup, mesh, mesh_name(setup), needs);
  check_scene_mesh(mesh, needs, mesh_source(setup));
  for (auto& line : open_and_closed_surfaces(setup, mesh, needs, mesh_name(setup))) remarks.push_back(std::move(line));
  note_opening_pieces(setup, mesh, notices, remarks);
  if (!needs.left_out.empty())
    notices.push_back(
        fmt::format("{}: {}: left out, since no section of [structure.layers] has {}", mesh_source(setup),
                    fmt::join(needs.left_out, ", "),
                    needs.left_out.size() == 1 ? "the name of this volume" : "the names of these volumes"));
  // Made meshes come in a good order already.
  auto ordered = renumbered(mesh, reverse_cuthill_mckee(mesh));
  return bandwidth(ordered) < bandwidth(mesh) ? ordered : mesh;
}

template <class Part>
FieldGrid grid_of(const std::string& name, const Part& part) {
  FieldGrid grid;
  grid.name = name;
  grid.points = part.nodes;
  grid.nodes_per_cell = static_cast<int>(std::tuple_size_v<typename Part::Cell>);
  for (const auto& cell : part.cells) grid.cells.insert(grid.cells.end(), cell.begin(), cell.end());
  grid.layer = part.cell_region;
  return grid;
}

/// The grid of a medium, if the scene has it; of a scene that is shared out what this process writes of it, if the run
/// writes fields at all. \param whole  of such a scene
template <class Part, int n>
void add_grid(const std::string& name, const Case& setup, const Part* here, const Part* whole, LoadedScene<n>& loaded) {
  if (here == nullptr) return;
  if (!here->share) {
    loaded.grids.push_back(grid_of(name, *here));
  } else if (writes_fields(setup)) {
    FieldGrid grid = grid_of(name, *whole);
    loaded.grid_shares.push_back(share_out<n>(grid, *here));
    loaded.grids.push_back(std::move(grid));
  }
}

/// Processes solve one scene: all must have read the same, and none of them can be of use without nodes.
/// \param hash  of the mesh
template <class Mesh>
void require_alike(const Case& setup, const Mesh& mesh, const std::string& hash, const Communicator& processes) {
  if (processes.is_alone()) return;
  const std::string mine = hash_of_case(setup) + hash;
  std::string of_first = mine;
  processes.broadcast(of_first);
  if (processes.any(mine != of_first))
    throw InputError(mesh_source(setup), "", "is not the same on all hosts, or the case file is not",
                     "give files that all processes see");
  if (static_cast<std::size_t>(processes.size()) > mesh.nodes.size())
    throw InputError(
        mesh_source(setup), "", fmt::format("has {} nodes for {} processes", mesh.nodes.size(), processes.size()),
        fmt::format("start at most {} processes; a thousand nodes for each are of use", mesh.nodes.size()));
}

/// Of the circle that has the area of the widest opening, mm; in plane scenes the length of it.
template <class Element>
double widest_opening(const Case& setup, const MeshOf<Element>& mesh) {
  double widest = 0;
  for (const auto& opening : openings_of(setup)) {
    double area = 0;
    for (const auto& f : group_facets(mesh, opening.surface)) {
      const auto x = [&](int i) { return mesh.nodes[f[i]]; };
      if constexpr (Element::dim == 3)
        area += norm(triangle_area_vector(x(0), x(1), x(2)));
      else
        area += distance(x(0), x(1));
    }
    const double diameter = Element::dim == 3       ? 2 * std::sqrt(area / 3.14159265358979323846)
                            : Element::axisymmetric ? 2 * area
                                                    : area;
    widest = std::max(widest, diameter);
  }
  return widest;
}

/// How large the vessel is that a case is about.
template <class Element>
VesselSize size_of_mesh(const Case& setup, const MeshOf<Element>& mesh) {
  VesselSize size;
  size.opening = widest_opening<Element>(setup, mesh);
  const Point extent = BoundingBox(mesh.nodes).extent();
  size.extent = *std::max_element(extent.begin(), extent.end());
  return size;
}

/// The wall's thickness in words.
std::string said_of(const ThicknessRange& wall) {
  return fmt::format("the wall is {:.4g} mm thick at {} to {:.4g} mm at {}", wall.least.distance,
                     place_of(wall.least.at), wall.most.distance, place_of(wall.most.at));
}

/// What a run reads off its fields, and the grids that they are written on.
/// \param parts  of the scene, here \param whole  parts of a mesh that is shared out; empty: `parts` are whole
template <class Element>
void find_samples(const Case& setup, const MeshOf<Element>& mesh, const SceneParts<Element>& parts,
                  const WholeParts<Element>& whole, LoadedScene<Element::components>& loaded) {
  VesselParts<Element> here;
  if (parts.fluid) here.fluid = &parts.fluid->part;
  if (parts.wall) here.wall = &parts.wall->part;
  VesselParts<Element> vessel = here;
  if (whole.fluid) vessel.fluid = whole.fluid.get();
  if (whole.wall) vessel.wall = whole.wall.get();
  loaded.points = observation_points<Element>(setup, mesh, vessel, mesh_source(setup));
  loaded.points.requested = requested_samples<Element>(setup, mesh, vessel, loaded.points);
  const bool shared = whole.fluid || whole.wall;
  if (shared) restrict_samples(whole.fluid_here.get(), whole.wall_here.get(), loaded.points);
  add_grid("fluid", setup, here.fluid, whole.fluid.get(), loaded);
  add_grid("wall", setup, here.wall, whole.wall.get(), loaded);
}

template <class Element>
LoadedScene<Element::components> load(const Case& setup, const LoadingScene& loading) {
  std::vector<std::string> remarks = setup.remarks, notices;
  auto mesh = load_mesh<Element>(setup, remarks, notices);
  const Communicator& processes = Communicator::world();
  const std::string hash = hash_of_mesh(mesh);
  require_alike(setup, mesh, hash, processes);
  if (loading.mesh_known) loading.mesh_known(mesh.cells.size());
  if (const auto slip = unit_slip_of_mesh(setup, size_of_mesh<Element>(setup, mesh)); slip && loading.mesh_strange)
    loading.mesh_strange(mesh_source(setup) + ": " + *slip);
  LoadedScene<Element::components> loaded;
  loaded.mesh = {mesh_name(setup),
                 hash,
                 mesh.nodes.size(),
                 mesh.cells.size(),
                 Element::dim == 3 ? "tetrahedra" : "triangles",
                 surfaces_of(mesh),
                 setup.structure ? thickness_ranges(mesh, processes) : std::vector<ThicknessRange>()};
  if (!loaded.mesh.wall.empty()) remarks.push_back(said_of(loaded.mesh.wall.back()));
  // All that takes the whole mesh is found first, and of several processes each keeps its share of it. Unless derived
  // quantities take the mesh, too, it is given up before matrices are made.
  MeshShare share;
  WholeParts<Element> whole;
  if (!processes.is_alone()) share = share_mesh(mesh, processes);
  auto parts = find_parts<Element>(setup, mesh);
  if (!processes.is_alone()) whole = restrict_to(share, parts);
  find_samples<Element>(setup, mesh, parts, whole, loaded);
  if (!derived_from_mesh(setup)) {
    whole = {};
    share = {};
    mesh = {};
    give_back_memory();
  }
  loaded.scene = build_scene<Element>(setup, std::move(parts));
  auto& said = *loaded.scene;
  said.remarks.insert(said.remarks.begin(), remarks.begin(), remarks.end());
  said.notices.insert(said.notices.begin(), notices.begin(), notices.end());
  loaded.numbers = derived_numbers(setup, said);
  for (auto& warning : implausible_numbers(loaded.numbers)) said.notices.push_back(std::move(warning));
  if (setup.prestress && (loading.find_prestress || !setup.prestress->file.empty()))
    loaded.prestress = apply_prestress(setup, loaded.mesh.hash, *loaded.scene, loading.prestress_goes_on);
  loaded.derived = make_derived_quantities<Element>(setup, mesh, *loaded.scene, whole);
  if (loaded.scene->fluid) cut_through(loaded.scene->fluid->nodes(), loaded.points);
  return loaded;
}

/// load(), or says that these programs are without the element.
template <class Element>
LoadedScene<Element::components> load_if_compiled(const Case& setup, const LoadingScene& loading) {
  if constexpr (is_compiled<Element>)
    return load<Element>(setup, loading);
  else
    throw InputError(
        setup.path.string(), "element",
        "these programs were compiled for linear tetrahedra alone, as scripts/quickstart.sh does on its way "
        "to the first report",
        "let it go on to its end, or configure with -DFSI_FIRST_ELEMENT=OFF and build again");
}

}  // namespace

template <>
LoadedScene<3> load_scene(const Case& setup, const LoadingScene& loading) {
  return setup.element == ElementPair::p1 ? load_if_compiled<P1Tetrahedron>(setup, loading)
                                          : load_if_compiled<P2P1Tetrahedron>(setup, loading);
}

template <>
LoadedScene<2> load_scene(const Case& setup, const LoadingScene& loading) {
  if (setup.geometry == Geometry::axisymmetric)
    return setup.element == ElementPair::p1 ? load_if_compiled<P1AxisymmetricTriangle>(setup, loading)
                                            : load_if_compiled<P2P1AxisymmetricTriangle>(setup, loading);
  return setup.element == ElementPair::p1 ? load_if_compiled<P1PlaneTriangle>(setup, loading)
                                          : load_if_compiled<P2P1PlaneTriangle>(setup, loading);
}

}  // namespace fsi
