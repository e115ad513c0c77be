#include "meshes/mesh_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <optional>
#include <variant>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "host/standard_streams.hpp"
#include "mesh/cell_words.hpp"
#include "mesh/cells_across.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/quality.hpp"
#include "mesh/wall_faces.hpp"
#include "mesh_io/gmsh_reader.hpp"
#include "mesher/corner_cells.hpp"
#include "run/program.hpp"

namespace fsi {

namespace {

/// The mesh as the solvers will see it.
template <int Dim, int Order>
SimplexMesh<Dim, Order> read_again(const SimplexMesh<Dim, Order>& made, const std::string& file,
                                   TriangleGeometry plane) {
  return read_gmsh<Dim, Order>(file, made.regions, plane);
}

/// Readers may stop reading; a report that cannot be stored is an error.
void print_report(const std::string& text, const std::string& file) {
  if (const int error = try_to_print(text); error != 0 && !nobody_reads(error))
    throw InputError(
        "standard output", "",
        fmt::format("the report cannot be written ({}), the mesh {} is complete", std::strerror(error), file),
        "give -q, or let it go to a disk with space");
}

/// How many cells across the elements need, measured on a bend and a bifurcation (docs/evidence/evidence.md). Empty for
/// triangles and where cells_across() is.
template <int Dim, int Order>
std::string advice_on(const SimplexMesh<Dim, Order>& mesh) {
  if constexpr (Dim == 3) {
    if (const auto across = cells_across(mesh))
      return fmt::format(
          "The lumen, {:.3g} mm wide, is {:.1f} cells across. With the element p2p1, the default, 2.5 leave some 3 % "
          "of the "
          "pressure and 3.5 some 1.5 % (edges of {:.2g} and {:.2g} mm on average); with p1 it takes 8 for 3 to 4 %.\n",
          across->width, across->cells(), across->width / 2.5, across->width / 3.5);
  }
  return {};
}

/// A mesh whose corner cells are divided, and a sentence on them; empty if it has none.
struct Mended {
  std::optional<AnyMesh> mesh;
  std::string said;
};

template <int Dim, int Order>
Mended mended(const SimplexMesh<Dim, Order>& mesh) {
  constexpr std::size_t most = 4;
  const auto corners = corner_cells(mesh);
  if (corners.empty()) return {};
  std::string places;
  for (std::size_t i = 0; i < std::min(most, corners.size()); ++i)
    places += (i > 0 ? ", " : "") + place_of(centre_of_vertices(mesh, corners[i]));
  if (corners.size() > most) places += fmt::format(" and {} more", corners.size() - most);
  using Words = CellWords<Dim>;
  return {divided_at_centres(mesh, corners),
          fmt::format("{} of the fluid in corners, at {}: divided in {}, since a pressure there would have no equation "
                      "with the element p2p1 where the velocity is given all round.\n",
                      corners.size() == 1 ? fmt::format("1 {}", Words::cell)
                                          : fmt::format("{} {}", corners.size(), Words::cells),
                      places, Dim + 1)};
}

}  // namespace

void add_threads_option(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Taken as by all programs; one is all this needs")
      ->check(CLI::Range(0, 1024));
}

void add_output_options(CLI::App& command, MeshOutput& output, bool file_required) {
  command.add_option("-o,--output", output.file, "The file to write, .msh")->required(file_required);
  command.add_option("--format", output.format.version, "4.1 or 2.2")->capture_default_str();
  command.add_flag("--binary", output.format.binary, "Write binary data");
  add_threads_option(command, output.threads);
  command.add_flag("-q,--quiet", output.quiet, "No quality report and no warnings");
}

void require_known_extension(const std::string& file) {
  const auto extension = std::filesystem::path(file).extension().string();
  if (extension == ".msh") return;
  throw InputError(file, "--output",
                   extension.empty() ? "has no extension" : "the extension " + extension + " is unknown",
                   "the one that is known is .msh, gmsh 4.1 or 2.2 (--format), text or --binary");
}

void write_and_report(const AnyMesh& given, const MeshOutput& output, TriangleGeometry plane,
                      const std::string& foreword, bool warn) {
  const Mended corners = std::visit([](const auto& made) { return mended(made); }, given);
  const AnyMesh& mesh = corners.mesh ? *corners.mesh : given;
  std::string thickness;
  const auto quality = std::visit(
      [&](const auto& made) -> std::optional<MeshQuality> {
        write_gmsh(made, output.file, output.format);
        if (output.quiet) return std::nullopt;
        const auto written = read_again(made, output.file, plane);
        thickness = to_text(thickness_ranges(written));
        return measure_quality(written);
      },
      mesh);
  if (!quality) return;
  const std::string advice =
      output.advise ? std::visit([](const auto& made) { return advice_on(made); }, mesh) : std::string();
  print_report(
      foreword + corners.said +
          fmt::format("{}: {}", printable(output.shown.empty() ? output.file : output.shown), to_text(*quality)) +
          thickness + advice,
      output.file);
  if (!warn) return;
  for (const auto& warning : warnings_of(*quality)) fsi::warn(mesh_program, warning);
}

}  // namespace fsi
