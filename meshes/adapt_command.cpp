#include "meshes/adapt_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/printable.hpp"
#include "host/threads.hpp"
#include "mesher/bisection.hpp"
#include "mesher/geo_script.hpp"
#include "mesher/size_field.hpp"
#include "meshes/cell_errors.hpp"
#include "meshes/mesh_input.hpp"
#include "meshes/mesh_report.hpp"
#include "meshes/options.hpp"
#include "run/program.hpp"

namespace fsi {

namespace {

struct AdaptRequest {
  std::string file, run;
  std::vector<std::string> quantities;
  std::string script;                 ///< the mesh is made anew on this shape; empty: halved
  std::vector<std::string> settings;  ///< of its constants
  double nodes = 0;                   ///< 0: twice as many as there are
  MeshOutput output;
};

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

std::size_t nodes_of(const AnyMesh& mesh) {
  return std::visit([](const auto& any) { return any.nodes.size(); }, mesh);
}

/// Warns where the script decides the number of nodes otherwise than by sizes, as by counts of cells.
void warn_of_missed_nodes(const AdaptRequest& request, std::size_t made, std::size_t most) {
  constexpr double far = 0.2;
  if (request.output.quiet || std::abs(static_cast<double>(made) / static_cast<double>(most) - 1) <= far) return;
  warn(mesh_program,
       fmt::format(
           "{}: the mesh has {} nodes where {} were asked for: something else than the sizes decides how long its "
           "cells are; let the script give no counts of cells, or leave --geo out, which halves cells",
           printable(request.script), made, most));
}

/// The script's shape with cells as long as those of the halved mesh, times a factor that brings its nodes to a number
/// within a twentieth, if some tries find one; else the mesh of most nodes that has no more.
AnyMesh made_anew(const AdaptRequest& request, const SizeField& sizes, int order, std::size_t most) {
  constexpr int tries = 6;
  constexpr double near = 0.05;
  const auto numbers = numbers_of(request.settings);
  const auto file = regular_output_file(request.output.file);
  std::optional<AnyMesh> best;
  double factor = 1;
  for (int i = 0; i < tries; ++i) {
    const SizeField field = sizes.scaled(factor);
    AnyMesh made = mesh_of_geo_script(request.script, numbers, order, file, &field);
    const double ratio = static_cast<double>(nodes_of(made)) / static_cast<double>(most);
    const auto fits = [&](const AnyMesh& mesh) {
      return static_cast<double>(nodes_of(mesh)) <= (1 + near) * static_cast<double>(most);
    };
    const bool better = !best || (fits(made) ? !fits(*best) || nodes_of(made) > nodes_of(*best)
                                             : !fits(*best) && nodes_of(made) < nodes_of(*best));
    if (better) best = std::move(made);
    if (ratio >= 1 - near && ratio <= 1 + near) break;
    factor *= std::pow(ratio, 1.0 / sizes.dimension);
  }
  warn_of_missed_nodes(request, nodes_of(*best), most);
  return std::move(*best);
}

void require_fitting_script(const AdaptRequest& request, const ReadMesh& read_mesh) {
  if (!request.settings.empty() && request.script.empty())
    throw InputError("fsi-mesh", "--set", "is of a script's constants", "give the script as well: --geo SHAPE.geo");
  if (!request.script.empty() && read_mesh.plane == TriangleGeometry::axisymmetric)
    throw InputError(request.file, "--geo",
                     "the mesh lies in the plane y = 0, and no script of fsi-mesh geo draws there",
                     "leave --geo out, or give the mesh that the script made");
}

void make(const AdaptRequest& request) {
  require_known_extension(request.output.file);
  set_threads(request.output.threads);
  regular_output_file(request.output.file);  // before anything is computed
  const auto read_mesh = read_mesh_file(request.file);
  require_fitting_script(request, read_mesh);
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
        if (request.script.empty()) return write_and_report(adapted, output, read_mesh.plane, foreword);
        output.format.tags = {};  // the script's groups need not be the file's
        constexpr int order = std::decay_t<decltype(mesh)>::order;
        write_and_report(made_anew(request, sizes_of(adapted), order, plan.most_nodes), output, read_mesh.plane,
                         foreword);
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
  options->add_option(
      "--geo", request->script,
      "The gmsh script that the mesh is of: it is made anew, with nodes on the shape and cells as long as "
      "halving would leave them");
  options->add_option("--set", request->settings, "name=number: another value of a constant of the script");
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
