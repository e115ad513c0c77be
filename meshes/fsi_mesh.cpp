// fsi-mesh: makes meshes and reports their quality. A command is a file beside this one.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/version.hpp"
#include "host/available_memory.hpp"
#include "host/standard_streams.hpp"
#include "meshes/adapt_command.hpp"
#include "meshes/artery_command.hpp"
#include "meshes/check_command.hpp"
#include "meshes/geo_command.hpp"
#include "meshes/import_command.hpp"
#include "meshes/lumen_command.hpp"
#include "meshes/mesh_report.hpp"
#include "meshes/refine_command.hpp"
#include "meshes/thicken_command.hpp"
#include "meshes/vtk_command.hpp"
#include "run/interruption.hpp"
#include "run/program.hpp"

namespace {

/// Where help is to be found on the command that the command line names, for messages.
std::string help_of(const std::vector<fsi::MeshCommand>& commands) {
  std::string named = "artery";
  for (const auto& command : commands)
    if (command.options->parsed()) named = command.options->get_name();
  return fmt::format("see {} {} --help", fsi::mesh_program, named);
}

/// Does what the command line asks for; help and version are printed.
int run(int argc, const char* const* argv) {
  CLI::App app("Makes meshes for the FSI programs. Lengths in mm.", fsi::mesh_program);
  app.set_version_flag("--version", fsi::version_text(fsi::mesh_program));
  app.require_subcommand(1);
  const std::vector<fsi::MeshCommand> commands{
      fsi::artery_command(app), fsi::geo_command(app),     fsi::import_command(app),
      fsi::lumen_command(app),  fsi::thicken_command(app), fsi::refine_command(app),
      fsi::adapt_command(app),  fsi::check_command(app),   fsi::vtk_command(app)};
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    std::ostringstream text;
    app.exit(asked, text, text);
    fsi::print(text.str());
    return fsi::exit_done;
  } catch (const CLI::ParseError& mistake) {
    throw fsi::InputError("", "", mistake.what(), help_of(commands));
  }
  const fsi::Activity activity("making the mesh");
  for (const auto& command : commands)
    if (command.options->parsed()) command.run();
  return fsi::exit_done;
}

}  // namespace

int main(int argc, char** argv) {
  fsi::end_at_signals(fsi::mesh_program, "");
  return fsi::run_program(fsi::mesh_program, [&] { return run(argc, argv); });
}
