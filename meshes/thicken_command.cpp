#include "meshes/thicken_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "host/threads.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/group_names.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh_io/gmsh_reader.hpp"
#include "mesher/edge_curves.hpp"
#include "mesher/lumen_volume.hpp"
#include "mesher/surface/remeshing.hpp"
#include "mesher/wall_growth.hpp"
#include "meshes/curved_lumen.hpp"
#include "meshes/mesh_input.hpp"
#include "meshes/mesh_report.hpp"
#include "meshes/options.hpp"
#include "meshes/thickness_options.hpp"
#include "run/program.hpp"

namespace fsi {

namespace {

struct ThickenRequest {
  std::string lumen;
  std::vector<std::string> layers, openings, closed;
  WallGrowth growth;
  ThicknessOptions thickness;
  int order = 0;  ///< 0: that of the lumen's mesh
  MeshOutput output;
};

struct Lumen {
  TetrahedralMesh mesh;
  std::optional<EdgeCurves> curves;  ///< of its mesh, where that is quadratic
};

/// NAME=THICKNESS or NAME=THICKNESS:ELEMENTS. \param share  the thickness is SHARE%, of a wall that varies
GrownLayer layer_of(const std::string& text, bool share) {
  const std::string remedy =
      share ? "the wall's thickness varies: write, for one, --layer media=67%:2, for two thirds of it, of two elements"
            : "write, for one, --layer media=0.26:2, for 0.26 mm of two elements";
  const auto equals = text.find('=');
  const auto colon = text.find(':', equals == std::string::npos ? 0 : equals);
  GrownLayer layer{text.substr(0, equals)};
  if (equals == std::string::npos || layer.name.empty())
    throw InputError("--layer", text, "is no NAME=THICKNESS", remedy);
  std::string thickness = text.substr(equals + 1, colon == std::string::npos ? colon : colon - equals - 1);
  if (share) {
    if (thickness.empty() || thickness.back() != '%')
      throw InputError("--layer", text, "'" + thickness + "' is no share of the wall", remedy);
    thickness.pop_back();
  }
  if (!CLI::detail::lexical_cast(thickness, layer.thickness) || !(layer.thickness > 0 && layer.thickness < 1e6))
    throw InputError("--layer", text, "'" + thickness + "' is no thickness in mm", remedy);
  if (share) layer.thickness /= 100;
  if (colon != std::string::npos && (!CLI::detail::lexical_cast(text.substr(colon + 1), layer.elements) ||
                                     layer.elements < 1 || layer.elements > 100))
    throw InputError("--layer", text, "'" + text.substr(colon + 1) + "' is no number of elements from 1 to 100",
                     remedy);
  return layer;
}

/// A mesh of the lumen's volume, or of its surface, which is filled.
Lumen lumen_of(const ThickenRequest& request) {
  const std::filesystem::path file = request.lumen;
  const auto openings = flat_parts_of(request.openings);
  Lumen lumen;
  if (file.extension() == ".msh" && gmsh_dimension(file) == 3) {
    if (gmsh_order(parse_gmsh(file), 3) == 2) {
      const auto mesh = read_gmsh<3, 2>(file, {group::fluid});
      warn_of_astray(file, mesh);
      lumen = {without_mid_edge_nodes(mesh), curves_of(mesh)};
    } else {
      lumen.mesh = read_gmsh<3, 1>(file, {group::fluid});
      warn_of_astray(file, lumen.mesh);
    }
    name_flat_parts(lumen.mesh, openings);
    return lumen;
  }
  lumen.mesh = fill_lumen(file, openings);
  return lumen;
}

double curved_volume(const TetrahedralMesh& lumen, const EdgeCurves& curves) {
  return volume_of(with_curves(lumen, curves), lumen.region_index(group::fluid));
}

void report(const AnyMesh& mesh, const ThickenRequest& request, const std::string& said, MeshWarnings warnings,
            const ReachedThickness& reached = {}) {
  write_and_report(mesh, request.output, TriangleGeometry::plane, said);
  if (request.output.quiet) return;
  for (auto& warning : warnings_of(reached)) warnings.push_back(std::move(warning));
  for (const auto& warning : warnings) warn(mesh_program, warning);
}

/// Curved facets of a surface as four flat ones each.
TriangleSurface flattened(const SimplexMesh<3, 2>& mesh, const std::string& surface) {
  TriangleSurface flat{mesh.nodes, {}};
  for (const auto& [a, b, c, ab, bc, ca] : *mesh.facets(surface))
    for (const auto& part : {SurfaceTriangle{a, ab, ca}, SurfaceTriangle{ab, b, bc}, SurfaceTriangle{ca, bc, c},
                             SurfaceTriangle{ab, bc, ca}})
      flat.triangles.push_back(part);
  return flat;
}

constexpr const char* no_room = "there is no room for the wall there: give thinner layers, or draw its parts apart";

void make_linear(const ThickenRequest& request, const Lumen& lumen) {
  std::string said;
  if (lumen.curves)
    said = "The lumen's curved edges are made straight, as --order 1 asks. " +
           changed_volume("curved", curved_volume(lumen.mesh, *lumen.curves), "straight", straight_volume(lumen.mesh));
  if (request.growth.layers.empty()) {
    report(lumen.mesh, request, said, {});
    return;
  }
  const auto grown = grow_wall(lumen.mesh, request.growth);
  require_no_cuts({grown.mesh.nodes, *grown.mesh.facets(group::outer)}, "--layer", no_room);
  said +=
      "Cells are linear. With the element p2p1 a round wall of them is a polygon, which bends: --order 2 is for it.\n";
  report(grown.mesh, request, said, {}, grown.reached);
}

void make_quadratic(const ThickenRequest& request, Lumen& lumen) {
  std::string said;
  MeshWarnings warnings;
  const double before = straight_volume(lumen.mesh);
  EdgeCurves curves =
      lumen.curves ? std::move(*lumen.curves) : curves_of_lumen(lumen.mesh, request.growth.on, {}, said, warnings);
  const auto say_volume = [&](const SimplexMesh<3, 2>& mesh) {
    said += lumen.curves
                ? "The lumen's edges are curved as in its mesh.\n"
                : changed_volume("straight", before, "curved", volume_of(mesh, mesh.region_index(group::fluid)));
  };
  if (request.growth.layers.empty()) {
    const auto mesh = with_curves(lumen.mesh, curves);
    say_volume(mesh);
    report(mesh, request, said, warnings);
    return;
  }
  const auto grown = grow_quadratic_wall(lumen.mesh, std::move(curves), !lumen.curves, request.growth);
  require_no_cuts(flattened(grown.mesh, group::outer), "--layer", no_room);
  say_volume(grown.mesh);
  add_straightened(grown.straightened, "the wall", warnings);
  report(grown.mesh, request, said, warnings, grown.reached);
}

void make(ThickenRequest& request) {
  require_known_extension(request.output.file);
  set_threads(request.output.threads);
  regular_output_file(request.output.file);  // before anything is computed
  for (const auto& text : request.layers) request.growth.layers.push_back(layer_of(text, request.thickness.varies()));
  auto lumen = lumen_of(request);
  if (request.growth.on.empty()) require_flat_parts_named(lumen.mesh, points_of("--closed", request.closed));
  request.growth.total = total_thickness(lumen.mesh, request.growth, request.thickness);
  if (request.order == 2 || (request.order == 0 && lumen.curves))
    make_quadratic(request, lumen);
  else
    make_linear(request, lumen);
}

}  // namespace

MeshCommand thicken_command(CLI::App& app) {
  auto* options = app.add_subcommand("thicken", "A wall of given layers, grown on a lumen's surface");
  const auto request = std::make_shared<ThickenRequest>();
  options
      ->add_option("lumen", request->lumen,
                   "Mesh of the lumen (.msh with a volume fluid), or its closed surface (.stl, .msh), which is filled")
      ->required();
  options->add_option(
      "--layer", request->layers,
      "NAME=THICKNESS[:ELEMENTS], from the lumen outwards; NAME=SHARE%[:ELEMENTS] of a wall that varies; "
      "none: the lumen alone");
  add_thickness_options(*options, request->thickness);
  options->add_option("--opening", request->openings,
                      "NAME=X,Y,Z: of a surface without names, the flat part on which this point lies");
  options->add_option("--closed", request->closed, "X,Y,Z: a flat part on which this point lies is wall, no opening");
  options->add_option("--on", request->growth.on,
                      "Surface that the wall grows on; all that has no name, or is called inner, unless given");
  options->add_option("--smoothing", request->growth.smoothing, "Times that the normals are averaged with neighbours'")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
  options
      ->add_option(
          "--order", request->order,
          "1: straight edges; 2: quadratic cells with curved edges, for the element p2p1; that of the lumen's mesh "
          "unless given. A lumen of straight edges gets curved ones along the wall, by the normals of its surface")
      ->check(CLI::Range(1, 2));
  add_output_options(*options, request->output);
  request->output.advise = true;
  return {options, [request] { make(*request); }};
}

}  // namespace fsi
