#include "meshes/lumen_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/printable.hpp"
#include "host/standard_streams.hpp"
#include "host/threads.hpp"
#include "mesh/group_names.hpp"
#include "mesher/edge_curves.hpp"
#include "mesher/surface/lumen_mesh.hpp"
#include "meshes/curved_lumen.hpp"
#include "meshes/mesh_report.hpp"
#include "meshes/options.hpp"
#include "meshes/surface_input.hpp"
#include "run/program.hpp"

namespace fsi {

namespace {

struct LumenOptions {
  SurfaceInput input;
  std::vector<std::string> openings, closed, cuts, extensions;
  bool list = false;
  int order = 1;
  LumenRequest request;
  MeshOutput output;
};

/// Layers are given by their first thickness, or by the Womersley number.
void require_layers(const LumenRequest& request) {
  const bool sized = request.layers.first > 0 || request.womersley > 0;
  if (request.layers.count > 0 && !sized)
    throw InputError(mesh_program, "--layers", "has no thickness", "give --first-thickness MM or --womersley NUMBER");
  if (request.layers.count == 0 && sized)
    throw InputError(mesh_program, "--layers", "is not given", "say how many: --layers 4, for one");
}

/// The same mesh, edges along its wall curved.
SimplexMesh<3, 2> quadratic(const LumenMesh& made, std::string& said, MeshWarnings& warnings) {
  auto mesh = with_curves(made.mesh, curves_of_lumen(made.mesh, "", made.layers, said, warnings));
  said += changed_volume("straight", straight_volume(made.mesh), "curved",
                         volume_of(mesh, mesh.region_index(group::fluid)));
  return mesh;
}

void make(LumenOptions& options) {
  std::vector<std::string> done;
  auto& request = options.request;
  if (options.list) {
    const auto lumen = read_lumen_surface(options.input, done);
    const auto fault = not_a_lumen(lumen);
    std::string text;
    for (const auto& sentence : done) text += sentence + "\n";
    if (!lumen.openings.empty()) print(text + to_text(lumen.openings));
    if (fault) throw InputError(options.input.file, "surface", fault.problem, fault.remedy);
    return;
  }
  if (options.output.file.empty())
    throw InputError(mesh_program, "--output", "is not given", "give -o FILE.msh, or --list-openings");
  require_known_extension(options.output.file);
  set_threads(options.output.threads);
  regular_output_file(options.output.file);  // before anything is computed
  for (const auto& text : options.openings) request.openings.push_back(opening_choice_of(text));
  for (const auto& text : options.closed) request.closed.push_back(closed_choice_of(text));
  request.cuts = lengths_of("--cut", options.cuts);
  request.extensions = lengths_of("--extension", options.extensions);
  request.file = options.input.file;
  require_layers(request);
  auto lumen = read_lumen_surface(options.input, done);
  const auto made = mesh_lumen(std::move(lumen), request);
  done.insert(done.end(), made.done.begin(), made.done.end());
  std::string foreword;
  for (const auto& sentence : done) foreword += sentence + "\n";
  const bool flat_cells_count = request.layers.count == 0;
  if (options.order == 1) {
    write_and_report(made.mesh, options.output, TriangleGeometry::plane, foreword, flat_cells_count);
    return;
  }
  MeshWarnings warnings;
  const auto mesh = quadratic(made, foreword, warnings);
  write_and_report(mesh, options.output, TriangleGeometry::plane, foreword, flat_cells_count);
  if (options.output.quiet) return;
  for (const auto& warning : warnings) warn(mesh_program, warning);
}

void add_layer_options(CLI::App& command, LumenRequest& request) {
  command.add_option("--layers", request.layers.count, "Layers of thin cells along the wall")->check(CLI::Range(1, 50));
  auto* first = command.add_option("--first-thickness", request.layers.first, "Of the cells at the wall, mm")
                    ->check(CLI::PositiveNumber);
  command.add_option("--growth", request.layers.growth, "Thickness of a layer over that of the one before")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 3.0));
  command
      .add_option("--womersley", request.womersley,
                  "In place of a thickness: R sqrt(omega / nu) of the widest opening; the layers are as thick as the "
                  "Stokes layer")
      ->excludes(first)
      ->check(CLI::PositiveNumber);
}

}  // namespace

MeshCommand lumen_command(CLI::App& app) {
  auto* command = app.add_subcommand("lumen", "The mesh of a lumen, from a segmented surface as it comes");
  const auto options = std::make_shared<LumenOptions>();
  command->add_option("surface", options->input.file, "Surface of the lumen, open or closed: .stl, .ply, .obj or .vtp")
      ->required();
  command->add_flag("--list-openings", options->list,
                    "Print number, area, place and normal of each opening, and write nothing");
  command->add_option("--opening", options->openings,
                      "NAME=NUMBER or NAME=X,Y,Z: names an opening, by its number in the list or by a point near it");
  command->add_option("--closed", options->closed,
                      "NUMBER or X,Y,Z: a hole or flat part that is no opening; it is closed");
  command->add_option("--unit", options->input.unit, "Unit of length of the surface's file; mm unless given")
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  command->add_flag("--largest-shell", options->input.largest_shell,
                    "Leave out all parts of the surface but the largest");
  command->add_option("--smoothing", options->request.smoothing, "Passes of smoothing that keeps the volume (Taubin's)")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
  command
      ->add_option("--edge-length", options->request.edge, "Length of the surface's edges, mm; their mean unless given")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--edges-per-diameter", options->request.edges_per_diameter,
                   "In place of a length: edges along the local diameter, for surfaces that widen and narrow")
      ->excludes("--edge-length")
      ->check(CLI::Range(1.0, 100.0));
  auto* bent =
      command
          ->add_option("--edges-per-curvature", options->request.edges_per_curvature,
                       "Beside these: edges along the diameter of the circle of curvature, where that is shorter")
          ->check(CLI::Range(1.0, 100.0));
  command
      ->add_option("--shortest-edge", options->request.shortest_edge,
                   "That curvature asks for, mm; half the surface's mean unless given")
      ->needs(bent)
      ->check(CLI::PositiveNumber);
  command->add_option("--cut", options->cuts,
                      "NAME=LENGTH: cut this opening square to the centre line, mm behind its centre");
  command->add_option("--extension", options->extensions,
                      "NAME=DIAMETERS: draw this opening out by so many of its diameters, to a circle");
  add_layer_options(*command, options->request);
  command
      ->add_option("--order", options->order,
                   "1: straight edges; 2: quadratic cells, edges along the wall curved by the normals of its surface, "
                   "for the element p2p1")
      ->capture_default_str()
      ->check(CLI::Range(1, 2));
  add_output_options(*command, options->output, false);
  options->output.advise = true;
  return {command, [options] { make(*options); }};
}

}  // namespace fsi
