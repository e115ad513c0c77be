#include "meshes/geo_command.hpp"

#include <memory>
#include <string>
#include <vector>

#include "base/output_file.hpp"
#include "host/threads.hpp"
#include "mesher/geo_script.hpp"
#include "meshes/mesh_report.hpp"
#include "meshes/options.hpp"

namespace fsi {

namespace {

struct GeoRequest {
  std::string script;
  std::vector<std::string> settings;  ///< name=number
  int order = 1;
  MeshOutput output;
};

void make(const GeoRequest& request) {
  require_known_extension(request.output.file);
  set_threads(request.output.threads);
  const auto file = regular_output_file(request.output.file);
  const auto mesh = mesh_of_geo_script(request.script, numbers_of(request.settings), request.order, file);
  write_and_report(mesh, request.output, TriangleGeometry::plane);
}

}  // namespace

MeshCommand geo_command(CLI::App& app) {
  auto* options = app.add_subcommand("geo", "A shape that a gmsh script (.geo) describes");
  const auto request = std::make_shared<GeoRequest>();
  options->add_option("script", request->script, "The script, .geo")->required();
  options->add_option("--set", request->settings, "name=number: another value of a constant of the script");
  options
      ->add_option("--order", request->order,
                   "1: straight edges; 2: quadratic cells with nodes on the shape, for the element p2p1")
      ->capture_default_str()
      ->check(CLI::Range(1, 2));
  add_output_options(*options, request->output);
  request->output.advise = true;
  return {options, [request] { make(*request); }};
}

}  // namespace fsi
