// fsi-mesh: makes the artery meshes and reports their quality.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "base/threads.hpp"
#include "base/version.hpp"
#include "mesh/artery_generator.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/gmsh_writer.hpp"
#include "mesh/quality.hpp"

namespace {

struct Request {
  std::string level = "coarse", file;
  fsi::ArteryOptions artery;
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

/// Writes the mesh and prints its quality as the solvers will see it; warnings of bad elements go to stderr.
void make_artery(const Request& request) {
  const auto made = fsi::generate_artery(request.artery);
  fsi::write_gmsh(made, request.file, request.format);
  if (request.quiet) return;
  const auto quality = fsi::measure_quality(fsi::read_gmsh(request.file, made.regions));
  fmt::print("{}: {}", request.file, fsi::to_text(quality));
  std::fflush(stdout);
  for (const auto& warning : fsi::warnings_of(quality)) fmt::print(stderr, "fsi-mesh: warning: {}\n", warning);
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  double size = 0, axial_size = 0;
  fsi::ArteryOptions& shape = request.artery;

  CLI::App app("Makes meshes for the FSI programs. Lengths in mm.", "fsi-mesh");
  app.set_version_flag("--version", fmt::format("fsi-mesh {}", fsi::version));
  app.require_subcommand(1);
  CLI::App* artery = app.add_subcommand("artery", "A straight two-layer artery along the z axis from (0,0,0)");
  artery->add_option("--level", request.level, "coarse, intermediate or fine: sets both sizes")->capture_default_str();
  artery->add_option("-o,--output", request.file, "The file to write, .msh")->required();
  artery->add_option("--inner-radius", shape.inner_radius, "Radius of the lumen")->capture_default_str();
  artery->add_option("--media", shape.media, "Thickness of the inner layer")->capture_default_str();
  artery->add_option("--adventitia", shape.adventitia, "Thickness of the outer layer; 0: none")->capture_default_str();
  artery->add_option("--length", shape.length, "Length along the axis")->capture_default_str();
  auto* sized =
      artery->add_option("--size", size, "Element size across and, unless given, along; instead of the level's");
  auto* stretched = artery->add_option("--axial-size", axial_size, "Element size along the axis");
  artery->add_option("--format", request.format.version, "4.1 or 2.2")->capture_default_str();
  artery->add_flag("--binary", request.format.binary, "Write binary data");
  artery->add_option("--threads", request.threads, "Taken as by all programs; one is all this needs")
      ->check(CLI::Range(0, 1024));
  artery->add_flag("-q,--quiet", request.quiet, "No quality report and no warnings");

  try {
    app.parse(argc, argv);
    const auto level = fsi::artery_level(request.level);
    shape.size = sized->count() > 0 ? size : level.size;
    if (sized->count() == 0) shape.axial_size = level.axial_size;
    if (stretched->count() > 0) shape.axial_size = axial_size;
    require_known_extension(request.file);
    fsi::set_threads(request.threads);
    make_artery(request);
    return fsi::exit_done;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& mistake) {
    fmt::print(stderr, "fsi-mesh: {}; see fsi-mesh artery --help\n", mistake.what());
  } catch (const std::exception& mistake) {
    fmt::print(stderr, "{}\n", mistake.what());
  }
  return fsi::exit_bad_input;
}
