#include "meshes/refine_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>

#include "base/output_file.hpp"
#include "base/printable.hpp"
#include "host/threads.hpp"
#include "mesh/quality.hpp"
#include "mesher/uniform_refinement.hpp"
#include "meshes/mesh_input.hpp"
#include "meshes/mesh_report.hpp"
#include "run/program.hpp"

namespace fsi {

namespace {

namespace fs = std::filesystem;

struct RefineRequest {
  std::string file;
  int times = 1;
  MeshOutput output;
};

constexpr const char* other_sizes =
    "For sizes in between, 1.4 times finer say, mesh the shape again: fsi-mesh geo SHAPE.geo --set NAME=SIZE, or the "
    "sizes "
    "of fsi-mesh artery and thicken";

/// Counts and qualities of the mesh, and how the qualities changed.
std::string before_and_after(const RefineRequest& request, const MeshQuality& before, const MeshQuality& after) {
  const bool solid = before.dimension == 3;
  const auto cells = solid ? "tetrahedra" : "triangles";
  std::string text = fmt::format("{}: {} nodes, {} {}{}, smallest eta {:.3f}, mean eta {:.3f}\n",
                                 printable(request.file), before.nodes, before.cells,
                                 before.order == 2 ? "quadratic " : "", cells, before.min_eta, before.mean_eta);
  const double parts = std::pow(solid ? 8 : 4, request.times);
  text += fmt::format("Each cell cut in {:.0f}: the smallest eta is {:.3f} of what it was, the mean {:.3f}.", parts,
                      after.min_eta / before.min_eta, after.mean_eta / before.mean_eta);
  if (before.order == 2) text += " Curved edges stay on the curves that the mesh gives them.";
  text += "\n";
  auto script = fs::path(request.file).replace_extension(".geo");
  std::error_code ignored;
  if (fs::exists(script, ignored))
    text += fmt::format(
        "{} lies beside it: fsi-mesh geo with --set makes meshes of any size, whose nodes lie on the shape.\n",
        printable(script.string()));
  return text;
}

/// Straight cells cannot fall below the bound; quadratic ones are judged by the straight cells between their vertices.
void warn_of_lost_quality(const std::string& file, const MeshQuality& before, const MeshQuality& after) {
  if (after.min_eta >= least_child_ratio * before.min_eta) return;
  warn(mesh_program,
       fmt::format(
           "{}: the smallest eta falls from {:.3f} to {:.3f}, to less than {:g} of it, where edges are curved; mesh "
           "finer there instead",
           printable(file), before.min_eta, after.min_eta, least_child_ratio));
}

void make(const RefineRequest& request) {
  require_known_extension(request.output.file);
  set_threads(request.output.threads);
  regular_output_file(request.output.file);  // before anything is computed
  const auto read_mesh = read_mesh_file(request.file);
  auto output = request.output;
  output.format.tags = read_mesh.tags;
  std::visit(
      [&](const auto& mesh) {
        const auto refined = request.times > 0 ? refine_uniformly(mesh, request.times, request.file) : mesh;
        std::string foreword;
        if (!output.quiet) {
          const auto before = measure_quality(mesh), after = measure_quality(refined);
          if (request.times > 0) foreword = before_and_after(request, before, after);
          warn_of_lost_quality(request.file, before, after);
          warn_of_left_out(request.file, read_mesh);
        }
        write_and_report(refined, output, read_mesh.plane, foreword);
      },
      read_mesh.mesh);
}

}  // namespace

MeshCommand refine_command(CLI::App& app) {
  auto* options = app.add_subcommand("refine", "A mesh that is there, its cells half as long");
  options->footer(
      std::string(
          "Each triangle is cut in four, each tetrahedron in eight; physical groups are kept.\n"
          "Quality: straight triangles keep their mean ratio eta. No part of a straight tetrahedron has less than "
          "0.75 of its eta, whatever --times is.\n"
          "Shape: quadratic cells are cut along their own coordinates. Curved edges and faces stay where they are, "
          "so that the error of a curved shape stays that of the file.\n"
          "Sizes: only halves are possible. ") +
      other_sizes + ".");
  const auto request = std::make_shared<RefineRequest>();
  options->add_option("mesh", request->file, "The mesh, .msh, of first or second order")->required();
  options
      ->add_option(
          "--times", request->times,
          "Number of halvings, one after the other; 0: the mesh as it is, but for the fluid's cells in corners, which "
          "every command divides")
      ->capture_default_str()
      ->check(CLI::Range(0, 10));
  add_output_options(*options, request->output);
  return {options, [request] { make(*request); }};
}

}  // namespace fsi
