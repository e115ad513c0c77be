#include "meshes/thicken_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/threads.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/group_names.hpp"
#include "mesh/lumen_volume.hpp"
#include "mesh/surface/remeshing.hpp"
#include "mesh/wall_growth.hpp"
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
  MeshOutput output;
};

/// NAME=THICKNESS or NAME=THICKNESS:ELEMENTS. \param share  the thickness is one of a wall that varies, SHARE%
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
TetrahedralMesh lumen_of(const ThickenRequest& request) {
  const std::filesystem::path file = request.lumen;
  const auto openings = flat_parts_of(request.openings);
  if (file.extension() == ".msh" && gmsh_dimension(file) == 3) {
    auto lumen = read_gmsh<3, 1>(file, {group::fluid});
    name_flat_parts(lumen, openings);
    return lumen;
  }
  return fill_lumen(file, openings);
}

void make(ThickenRequest& request) {
  require_known_extension(request.output.file);
  set_threads(request.output.threads);
  regular_output_file(request.output.file);  // before anything is computed
  for (const auto& text : request.layers) request.growth.layers.push_back(layer_of(text, request.thickness.varies()));
  const auto lumen = lumen_of(request);
  if (request.growth.on.empty()) require_flat_parts_named(lumen, points_of("--closed", request.closed));
  request.growth.total = total_thickness(lumen, request.growth, request.thickness);
  if (request.growth.layers.empty()) {
    write_and_report(lumen, request.output, TriangleGeometry::plane);
    return;
  }
  const auto grown = grow_wall(lumen, request.growth);
  require_no_cuts({grown.mesh.nodes, *grown.mesh.facets(group::outer)}, "--layer",
                  "there is no room for the wall there: give thinner layers, or draw its parts apart");
  write_and_report(grown.mesh, request.output, TriangleGeometry::plane);
  if (request.output.quiet) return;
  for (const auto& warning : warnings_of(grown.reached)) warn(mesh_program, warning);
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
  add_output_options(*options, request->output);
  request->output.advise = true;
  return {options, [request] { make(*request); }};
}

}  // namespace fsi
