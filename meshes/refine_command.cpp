#include "meshes/refine_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/printable.hpp"
#include "base/threads.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/quality.hpp"
#include "mesh/uniform_refinement.hpp"
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

/// A file's mesh, and what of the file the mesh does not know.
struct ReadMesh {
  AnyMesh mesh;
  TriangleGeometry plane;  ///< where triangles lie
  std::map<std::pair<int, std::string>, int> tags;
  std::size_t left_out = 0;  ///< cells in no physical group with a name
};

constexpr const char* other_sizes =
    "For sizes in between, 1.4 times finer say, mesh the shape again: fsi-mesh geo SHAPE.geo --set NAME=SIZE, or the "
    "sizes "
    "of fsi-mesh artery and thicken";

/// A script says how its shape is meshed, so there is nothing to cut.
void require_mesh(const std::string& file) {
  if (fs::path(file).extension() == ".geo")
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

AnyMesh read_any(const std::string& file, const std::vector<std::string>& regions, int dimension, int order,
                 TriangleGeometry plane) {
  if (dimension == 3)
    return order == 1 ? AnyMesh(read_gmsh<3, 1>(file, regions)) : AnyMesh(read_gmsh<3, 2>(file, regions));
  return order == 1 ? AnyMesh(read_gmsh<2, 1>(file, regions, plane)) : AnyMesh(read_gmsh<2, 2>(file, regions, plane));
}

ReadMesh read(const std::string& file) {
  require_mesh(file);
  ReadMesh result{{}, TriangleGeometry::plane, {}};
  int dimension = 0, order = 0;
  std::vector<std::string> regions;
  {
    const GmshFile parsed = parse_gmsh(file);
    dimension = std::max(2, gmsh_dimension(parsed));  // the reader says what a file without surfaces lacks
    order = gmsh_order(parsed, dimension);
    regions = regions_of(parsed, dimension);
    if (dimension == 2) result.plane = plane_of(parsed);
    for (const auto& name : parsed.names) result.tags.try_emplace({name.dimension, name.name}, name.tag);
    result.left_out = cells_in(parsed, dimension);
  }
  if (regions.empty())
    throw InputError(file, "$PhysicalNames", "the file names no physical volume and no physical surface",
                     "name the parts in gmsh, e.g. Physical Volume(\"fluid\") = {1};");
  result.mesh = read_any(file, regions, dimension, order, result.plane);
  result.left_out -= std::visit([](const auto& mesh) { return mesh.cells.size(); }, result.mesh);
  return result;
}

/// What the mesh was, and what became of its worst cell.
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
  const auto read_mesh = read(request.file);
  auto output = request.output;
  output.format.tags = read_mesh.tags;
  std::visit(
      [&](const auto& mesh) {
        const auto refined = refine_uniformly(mesh, request.times, request.file);
        std::string foreword;
        if (!output.quiet) {
          const auto before = measure_quality(mesh), after = measure_quality(refined);
          foreword = before_and_after(request, before, after);
          warn_of_lost_quality(request.file, before, after);
          if (read_mesh.left_out > 0)
            warn(mesh_program, fmt::format("{}: {} cells in no physical group with a name are left out",
                                           printable(request.file), read_mesh.left_out));
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
  options->add_option("--times", request->times, "Number of halvings, one after the other")
      ->capture_default_str()
      ->check(CLI::Range(1, 10));
  add_output_options(*options, request->output);
  return {options, [request] { make(*request); }};
}

}  // namespace fsi
