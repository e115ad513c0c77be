#include "meshes/adapt_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/printable.hpp"
#include "base/threads.hpp"
#include "mesh/bisection.hpp"
#include "meshes/cell_errors.hpp"
#include "meshes/mesh_input.hpp"
#include "meshes/mesh_report.hpp"

namespace fsi {

namespace {

struct AdaptRequest {
  std::string file, run;
  std::vector<std::string> quantities;
  double nodes = 0;  ///< 0: twice as many as there are
  MeshOutput output;
};

/// How many nodes the mesh may get.
std::size_t most_nodes(const AdaptRequest& request, std::size_t there) {
  const double most = request.nodes > 0 ? request.nodes : 2.0 * static_cast<double>(there);
  if (most <= static_cast<double>(there))
    throw InputError("fsi-mesh", "--nodes", fmt::format("{:.0f} are no more than the mesh has, {}", most, there),
                     "give a larger number: cells are halved, never joined");
  return static_cast<std::size_t>(most);
}

/// How evenly the error is spread over the cells: the largest share over the mean one.
double unevenness(const std::vector<double>& shares) {
  return *std::max_element(shares.begin(), shares.end()) * static_cast<double>(shares.size());
}

void make(const AdaptRequest& request) {
  require_known_extension(request.output.file);
  set_threads(request.output.threads);
  regular_output_file(request.output.file);  // before anything is computed
  const auto read_mesh = read_mesh_file(request.file);
  const auto errors = read_error_shares(read_mesh.mesh, request.run, request.quantities);
  auto output = request.output;
  output.format.tags = read_mesh.tags;
  if (!output.quiet) warn_of_left_out(request.file, read_mesh);
  std::visit(
      [&](const auto& mesh) {
        BisectionPlan plan;
        plan.weights = errors.shares;
        // |K| eta_K^2 of half a cell, whose edges are shorter by 2^(1/dim): eta as their power `order`.
        plan.shrinkage = 0.5 * std::pow(0.5, 2 * errors.order / std::decay_t<decltype(mesh)>::dim);
        plan.most_nodes = most_nodes(request, mesh.nodes.size());
        const auto adapted = bisect(mesh, plan, request.file);
        const auto foreword = fmt::format(
            "{}: {} nodes; by {} of {}, the largest share of a cell {:.0f} times the mean\n", printable(request.file),
            mesh.nodes.size(), fmt::join(errors.fields, ", "), printable(request.run), unevenness(errors.shares));
        write_and_report(adapted, output, read_mesh.plane, foreword);
      },
      read_mesh.mesh);
}

}  // namespace

MeshCommand adapt_command(CLI::App& app) {
  auto* options = app.add_subcommand("adapt", "A mesh that is finer where the error indicator of a run is large");
  const auto request = std::make_shared<AdaptRequest>();
  options->add_option("mesh", request->file, "The mesh of the run, .msh")->required();
  options->add_option("run", request->run, "Result folder of a run on it, with output.error_indicator = true")
      ->required();
  options
      ->add_option("--nodes", request->nodes,
                   "How many nodes the mesh may get, middles of quadratic edges among them; twice as many unless given")
      ->check(CLI::Range(1.0, 2e9));
  options->add_option("--of", request->quantities, "velocity, displacement, pressure: what counts; all unless given")
      ->delimiter(',')
      ->check(CLI::IsMember({"velocity", "displacement", "pressure"}));
  add_output_options(*options, request->output);
  options->footer(
      "The cells with the largest share of |K| eta_K^2 are halved through their longest edges, with their neighbours, "
      "until "
      "the nodes are used up. Quantities count alike, whatever their units. Physical groups are kept, and curved edges "
      "and "
      "faces stay where they are. Nothing is made coarser.");
  return {options, [request] { make(*request); }};
}

}  // namespace fsi
