#include "mesher/surface/lumen_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/group_names.hpp"
#include "mesher/lumen_volume.hpp"
#include "mesher/surface/curvature.hpp"
#include "mesher/surface/flow_extension.hpp"
#include "mesher/surface/local_radius.hpp"
#include "mesher/surface/remeshing.hpp"
#include "mesher/surface/square_cut.hpp"
#include "mesher/surface/taubin_smoothing.hpp"

namespace fsi {

namespace {

constexpr const char* program = "fsi-mesh";

void name_openings(std::vector<LumenOpening>& openings, const std::vector<OpeningChoice>& choices) {
  for (const auto& choice : choices) {
    const std::string option = "--opening " + choice.name;
    if (choice.name == group::fluid || group::is_no_opening(choice.name) || choice.name == group::wall_ends ||
        choice.name == group::outer)
      throw InputError(program, option, "is a name with another meaning", "give another one");
    for (const auto& opening : openings)
      if (opening.name == choice.name) throw InputError(program, option, "is given twice", "give each opening a name");
    auto& opening = openings[chosen(openings, choice, option)];
    if (!opening.name.empty())
      throw InputError(program, option, "is the same opening as " + opening.name,
                       "--list-openings shows which there are");
    opening.name = choice.name;
  }
}

/// Closes the openings that are to be wall and takes them off the list.
void close_holes(OpenedLumen& lumen, const LumenRequest& request, std::vector<std::string>& done) {
  std::set<std::size_t> closed;
  for (const auto& choice : request.closed) {
    const std::size_t number = chosen(lumen.openings, choice, "--closed");
    if (!lumen.openings[number].name.empty())
      throw InputError(program, "--closed", "is the opening " + lumen.openings[number].name,
                       "leave out one of the two");
    closed.insert(number);
  }
  if (!closed.empty() && closed.size() == lumen.openings.size())
    throw InputError(program, "--closed", "leaves the surface no opening",
                     "leave out those where blood enters and leaves");
  std::vector<LumenOpening> left;
  for (std::size_t i = 0; i < lumen.openings.size(); ++i) {
    auto& opening = lumen.openings[i];
    if (closed.count(i) == 0) {
      left.push_back(opening);
      continue;
    }
    close_hole(lumen.surface, rim_of(lumen.surface, opening), request.file);
    done.push_back(fmt::format("The opening at {} of {:.3g} mm^2 is closed.", place_of(opening.centre), opening.area));
  }
  lumen.openings = std::move(left);
}

void require_names(const std::vector<LumenOpening>& openings) {
  std::string places;
  for (std::size_t i = 0; i < openings.size(); ++i)
    if (openings[i].name.empty())
      places += fmt::format("{}number {} at {}, {:.3g} mm^2", places.empty() ? "" : ", ", i + 1,
                            place_of(openings[i].centre), openings[i].area);
  if (!places.empty())
    throw InputError(program, "--opening", "is not given for " + places,
                     "name each, --opening NAME=NUMBER, or say --closed NUMBER; --list-openings shows them");
}

LumenOpening& named(std::vector<LumenOpening>& openings, const std::string& name, const std::string& option) {
  std::string names;
  for (auto& opening : openings) {
    if (opening.name == name) return opening;
    names += (names.empty() ? "" : ", ") + opening.name;
  }
  throw InputError(program, option + " " + name, "is no opening", "the openings are " + names);
}

void smooth(TriangleSurface& surface, const LumenRequest& request, std::vector<std::string>& done) {
  constexpr double most = 0.01;
  const double before = enclosed_volume(surface);
  taubin_smooth(surface, request.smoothing);
  const double after = enclosed_volume(surface), change = after / before - 1;
  if (!(std::abs(change) <= most))
    throw InputError(program, "--smoothing",
                     fmt::format("{} passes change the volume from {:.5g} to {:.5g} mm^3, by {:.1f} %",
                                 request.smoothing, before, after, 100 * change),
                     "give fewer, or a surface of smaller triangles: 1 % is allowed");
  done.push_back(fmt::format("Smoothed {} times: volume {:.5g} mm^3 before, {:.5g} after ({:+.2f} %).",
                             request.smoothing, before, after, 100 * change));
}

/// \return what the edges are like, for the user
std::string remesh(TriangleSurface& surface, const LumenRequest& request) {
  if (request.edges_per_diameter > 0 || request.edges_per_curvature > 0) {
    std::vector<double> edges(surface.nodes.size(), request.edge > 0 ? request.edge : mean_edge(surface));
    std::string said;
    if (request.edges_per_diameter > 0) {
      edges = local_radius(surface, 10);
      if (!std::isfinite(edges.front()))
        throw InputError(program, "--edges-per-diameter", "the surface is flat: nothing of it faces it across a lumen",
                         "give --edge in mm");
      for (double& edge : edges) edge *= 2 / request.edges_per_diameter;
      said = fmt::format("{:.3g} edges per diameter, ", request.edges_per_diameter);
    }
    if (request.edges_per_curvature > 0) {
      const double shortest = request.shortest_edge > 0 ? request.shortest_edge : 0.5 * mean_edge(surface);
      shorten_by_curvature(surface, request.edges_per_curvature, shortest, edges);
      said += fmt::format("{:.3g} per diameter of curvature, ", request.edges_per_curvature);
    }
    const auto [least, most] = std::minmax_element(edges.begin(), edges.end());
    said += fmt::format("of {:.3g} to {:.3g} mm", *least, *most);
    surface = remeshed(surface, std::move(edges), request.file);
    return said;
  }
  const double edge = request.edge > 0 ? request.edge : mean_edge(surface);
  surface = remeshed(surface, edge, request.file);
  return fmt::format("edges of {:.3g} mm", edge);
}

/// The wall without a name, then each opening's cap. Rims are flat.
std::vector<TetrahedralMesh::FacetGroup> capped(TriangleSurface& surface, std::vector<LumenOpening>& openings,
                                                const std::string& file) {
  std::vector<TetrahedralMesh::FacetGroup> groups{{"", surface.triangles}};
  for (auto& opening : openings) groups.push_back({opening.name, flat_cap(surface, rim_of(surface, opening), file)});
  return groups;
}

BoundaryLayers layers_of(const LumenRequest& request, const std::vector<LumenOpening>& openings) {
  BoundaryLayers layers = request.layers;
  if (request.womersley > 0) {
    double widest = 0;
    for (const auto& opening : openings) widest = std::max(widest, opening.diameter());
    layers.first = 1;
    layers.first = std::sqrt(2.0) * 0.5 * widest / request.womersley / layers.thickness();
  }
  return layers;
}

/// Tetrahedra inside the wall, with layers of thin ones along it where they are asked for.
void fill(const TriangleSurface& wall, std::vector<LumenOpening>& openings, const LumenRequest& request,
          LumenMesh& made) {
  const BoundaryLayers layers = layers_of(request, openings);
  const TriangleSurface inner = layers.count > 0 ? moved_inwards(wall, layers) : wall;
  TriangleSurface closed = inner;
  const auto groups = capped(closed, openings, request.file);
  auto& mesh = made.mesh;
  mesh = fill_surface(closed.nodes, groups, request.file);
  if (layers.count == 0) return;
  const auto flat = mesh.cells.size();
  made.layers = grow_layers(mesh, wall, inner, layers);
  made.done.push_back(fmt::format("{} layers along the wall: {:.3g} mm at the wall, {:.3g} mm together, {} tetrahedra.",
                                  layers.count, layers.first, layers.thickness(), mesh.cells.size() - flat));
}

}  // namespace

LumenMesh mesh_lumen(OpenedLumen lumen, const LumenRequest& request) {
  LumenMesh made;
  const auto require_lumen = [&] {
    if (const auto fault = not_a_lumen(lumen)) throw InputError(request.file, "surface", fault.problem, fault.remedy);
  };
  if (lumen.openings.empty()) require_lumen();
  name_openings(lumen.openings, request.openings);
  close_holes(lumen, request, made.done);
  require_lumen();
  require_names(lumen.openings);
  auto& surface = lumen.surface;
  if (request.smoothing > 0) smooth(surface, request, made.done);
  for (const auto& [name, distance] : request.cuts) {
    auto& opening = named(lumen.openings, name, "--cut");
    cut_square(surface, opening, distance);
    made.done.push_back(
        fmt::format("{} is cut square at {}, {:.4g} mm^2.", name, place_of(opening.centre), opening.area));
  }
  for (auto& opening : lumen.openings) flatten_rim(surface, opening);
  for (const auto& [name, diameters] : request.extensions) {
    auto& opening = named(lumen.openings, name, "--extension");
    extend(surface, opening, diameters);
    made.done.push_back(fmt::format("{} is drawn out by {:.4g} mm, to {}.", name, diameters * opening.diameter(),
                                    place_of(opening.centre)));
  }
  const double before = enclosed_volume(surface);
  const std::string edges = remesh(surface, request);
  for (auto& opening : lumen.openings) flatten_rim(surface, opening);
  const double after = enclosed_volume(surface);
  const std::size_t triangles = surface.triangles.size();
  made.done.push_back(fmt::format("Remeshed to {}: {} triangles, volume {:.5g} mm^3 before, {:.5g} after ({:+.2f} %).",
                                  edges, triangles, before, after, 100 * (after / before - 1)));
  fill(surface, lumen.openings, request, made);
  made.openings = std::move(lumen.openings);
  return made;
}

}  // namespace fsi
