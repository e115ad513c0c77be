// fsi-mesh: makes the artery meshes and reports their quality.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstring>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <variant>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/output_file.hpp"
#include "base/printable.hpp"
#include "base/standard_streams.hpp"
#include "base/threads.hpp"
#include "base/version.hpp"
#include "driver/interruption.hpp"
#include "driver/program.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/gmsh_writer.hpp"
#include "mesh/quality.hpp"
#include "meshes/artery_request.hpp"

namespace {

constexpr const char* program = "fsi-mesh";

struct Request {
  std::string level = "coarse", file;
  std::optional<double> size, axial_size;
  fsi::ArteryRequest artery;
  fsi::GmshFormat format;
  int threads = 0;
  bool quiet = false;
};

/// The format is named by the version and --binary; another extension would promise another format.
void require_known_extension(const std::string& file) {
  const auto extension = std::filesystem::path(file).extension().string();
  if (extension == ".msh") return;
  throw fsi::InputError(file, "--output",
                        extension.empty() ? "has no extension" : "the extension " + extension + " is unknown",
                        "the one that is known is .msh, gmsh 4.1 or 2.2 (--format), text or --binary");
}

/// The quality of the mesh as the solvers will see it.
template <int Dim, int Order>
fsi::MeshQuality quality_of(const fsi::SimplexMesh<Dim, Order>& made, const std::string& file) {
  return fsi::measure_quality(fsi::read_gmsh<Dim, Order>(file, made.regions));
}

/// Nobody needs to read to the end; but a report that is to be kept and cannot be is an error.
void print_report(const std::string& text, const std::string& file) {
  if (const int error = fsi::try_to_print(text); error != 0 && !fsi::nobody_reads(error))
    throw fsi::InputError(
        "standard output", "",
        fmt::format("the report cannot be written ({}), the mesh {} is complete", std::strerror(error), file),
        "give -q, or let it go to a disk with space");
}

/// Writes the mesh and reports on it; warnings of bad elements go to stderr.
void make_artery(const Request& request) {
  fsi::regular_output_file(request.file);  // before anything is computed
  const auto made = fsi::make_artery(request.artery);
  std::visit([&](const auto& mesh) { fsi::write_gmsh(mesh, request.file, request.format); }, made);
  if (request.quiet) return;
  const auto* recommended = fsi::recommendation(request.artery);
  const auto quality = std::visit([&](const auto& mesh) { return quality_of(mesh, request.file); }, made);
  print_report((recommended ? fsi::to_text(*recommended) : "") +
                   fmt::format("{}: {}", fsi::printable(request.file), fsi::to_text(quality)),
               request.file);
  if (recommended) return;  // whose stretched elements are meant, and measured
  for (const auto& warning : fsi::warnings_of(quality)) fsi::warn(program, warning);
}

/// The options of `fsi-mesh artery`.
void add_options(CLI::App& artery, Request& request) {
  auto& asked = request.artery;
  auto& shape = asked.sizes;
  artery.add_option("-o,--output", request.file, "The file to write, .msh")->required();

  const auto in = [&](const char* group, CLI::Option* option) { return option->group(group); };
  const char* const dimensions = "Dimensions";
  in(dimensions, artery.add_option("--inner-radius", shape.inner_radius, "Radius of the lumen"))->capture_default_str();
  in(dimensions, artery.add_option("--media", shape.media, "Thickness of the inner layer"))->capture_default_str();
  in(dimensions, artery.add_option("--adventitia", shape.adventitia, "Thickness of the outer layer; 0: none"))
      ->capture_default_str();
  in(dimensions, artery.add_option("--length", shape.length, "Length along the axis"))->capture_default_str();

  const char* const sizes = "Sizes";
  auto* level = in(sizes, artery.add_option("--level", request.level, "coarse, intermediate or fine: sets both sizes"))
                    ->capture_default_str();
  auto* size = in(sizes, artery.add_option("--size", request.size,
                                           "Element size across and, unless given, along; instead of the level's"));
  auto* axial_size = in(sizes, artery.add_option("--axial-size", request.axial_size, "Element size along the axis"));

  const char* const numbers = "Numbers of cells, each instead of what the sizes come to";
  in(numbers, artery.add_option("--lumen-cells", asked.lumen_cells, "From the axis to the inner wall"));
  in(numbers, artery.add_option("--media-cells", asked.media_cells, "Through the inner layer"));
  in(numbers, artery.add_option("--adventitia-cells", asked.adventitia_cells, "Through the outer layer"));
  in(numbers, artery.add_option("--around", asked.around, "Around the whole circumference of the wall"));
  in(numbers, artery.add_option("--axial-cells", asked.axial_cells, "From inlet to outlet"));
  in(numbers, artery.add_option("--lumen-grading", asked.lumen_grading,
                                "Length of the cell at the axis over that at the wall: above 1 cells shrink towards "
                                "the wall, by equal ratios; 1 unless given"));
  in(numbers, artery.add_option("--axial-grading", asked.axial_grading,
                                "Length of the cell at the outlet over that at the inlet: above 1 cells shrink towards "
                                "the inlet, by equal ratios; 1 unless given"));

  const char* const kinds = "Kind of mesh";
  in(kinds, artery.add_option("--order", asked.order,
                              "1: straight edges; 2: quadratic cells, with nodes in the middles of edges that lie on "
                              "the cylinders; 2 with --for p2p1, else 1"));
  in(kinds, artery.add_flag("--axisymmetric", asked.axisymmetric,
                            "Triangles in the plane of radius and axis, for axisymmetric scenes"));
  in(kinds, artery.add_option("--sector", asked.sector,
                              "Degrees of the tube to mesh, a whole part of the circle, between planes of symmetry"))
      ->capture_default_str();
  in(kinds, artery.add_flag("--mirrored", asked.mirrored, "The sector and its mirror images: the whole tube"));

  const char* const accuracy = "Accuracy";
  auto* element =
      in(accuracy, artery.add_option("--for", asked.for_element, "Take the mesh recommended for this element: p2p1"));
  in(accuracy, artery.add_option("--error", asked.error,
                                 "Error that it may leave in the neo-Hookean wave, of pressure and of displacement, "
                                 "like 1%; 3% unless given"));
  in(accuracy,
     artery.add_option("--waves", asked.waves,
                       "damped: of backward Euler with 1/8 ms; resolved: of second order with 1/32 ms or less"))
      ->capture_default_str();
  for (auto* option : {level, size, axial_size}) element->excludes(option);

  artery.add_option("--format", request.format.version, "4.1 or 2.2")->capture_default_str();
  artery.add_flag("--binary", request.format.binary, "Write binary data");
  artery.add_option("--threads", request.threads, "Taken as by all programs; one is all this needs")
      ->check(CLI::Range(0, 1024));
  artery.add_flag("-q,--quiet", request.quiet, "No quality report and no warnings");
}

/// The level's sizes unless others are given.
void set_sizes(Request& request) {
  const auto level = fsi::artery_level(request.level);
  auto& sizes = request.artery.sizes;
  sizes.size = request.size.value_or(level.size);
  if (!request.size) sizes.axial_size = level.axial_size;
  if (request.axial_size) sizes.axial_size = request.axial_size;
}

/// Does what the command line asks for; help and version are printed.
int run(int argc, const char* const* argv) {
  Request request;
  CLI::App app("Makes meshes for the FSI programs. Lengths in mm.", program);
  app.set_version_flag("--version", fmt::format("{} {}", program, fsi::version));
  app.require_subcommand(1);
  add_options(*app.add_subcommand("artery", "A straight two-layer artery along the z axis from (0,0,0)"), request);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    std::ostringstream text;
    app.exit(asked, text, text);
    fsi::print(text.str());
    return fsi::exit_done;
  } catch (const CLI::ParseError& mistake) {
    throw fsi::InputError("", "", mistake.what(), "see fsi-mesh artery --help");
  }
  set_sizes(request);
  require_known_extension(request.file);
  fsi::set_threads(request.threads);
  const fsi::Activity activity("making the mesh");
  make_artery(request);
  return fsi::exit_done;
}

}  // namespace

int main(int argc, char** argv) {
  fsi::end_at_signals(program, "");
  return fsi::run_program(program, [&] { return run(argc, argv); });
}
