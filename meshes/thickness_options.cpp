#include "meshes/thickness_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "fields/field_samples.hpp"
#include "mesher/surface/local_radius.hpp"
#include "mesher/surface/wall_thickness.hpp"
#include "meshes/mesh_report.hpp"
#include "run/program.hpp"

namespace fsi {

namespace {

ThicknessTable read_table(const ThicknessOptions& options) {
  const std::filesystem::path file = options.file;
  constexpr const char* kinds = "give a table of points, .csv, or a surface with a field, .vtp";
  if (std::error_code error; !std::filesystem::is_regular_file(file, error))
    throw InputError(options.file, "", "no such file", kinds);
  if (file.extension() == ".vtp") {
    auto samples = read_field_samples(file, options.field);
    return {options.file, std::move(samples.places), std::move(samples.values)};
  }
  if (file.extension() != ".csv") throw InputError(options.file, "--thickness-from", "is no .csv and no .vtp", kinds);
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return thickness_table(text.str(), options.field, options.file);
}

}  // namespace

void add_thickness_options(CLI::App& command, ThicknessOptions& options) {
  auto* ratio =
      command
          .add_option("--thickness-ratio", options.ratio,
                      "The wall's thickness over the lumen's local radius; layers are shares: --layer media=67%")
          ->check(CLI::Range(1e-3, 10.0));
  command
      .add_option(
          "--thickness-from", options.file,
          "The wall's thickness, mm, at points on the surface or along the centre line: .csv with columns x, y, z, "
          "thickness, or x_cm and so on; .vtp with a field of its points")
      ->excludes(ratio);
  command.add_option("--thickness-field", options.field, "Its name in that file")->capture_default_str();
  command
      .add_option("--thickness-unit", options.unit,
                  "Unit of that file's lengths, of points and thickness: mm unless given, or as the header says")
      ->check(CLI::IsMember({"mm", "cm", "m", "um", "in"}));
  command.add_option("--thickness-points-unit", options.points_unit, "Of its points, where it is another one")
      ->check(CLI::IsMember({"mm", "cm", "m", "um", "in"}));
  command
      .add_option("--thickness-smoothing", options.smoothing,
                  "Times that a varying thickness is averaged with neighbours'")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
}

std::map<int, double> total_thickness(const TetrahedralMesh& lumen, const WallGrowth& growth,
                                      const ThicknessOptions& options) {
  std::map<int, double> total;
  if (!options.varies()) return total;
  double shares = 0;
  for (const auto& layer : growth.layers) shares += layer.thickness;
  if (growth.layers.empty() || std::abs(shares - 1) > 1e-6)
    throw InputError("--layer", "", fmt::format("the layers are {:.6g} % of the wall together", 100 * shares),
                     "give shares that make 100 %");
  TriangleSurface surface;
  std::map<int, int> number;
  for (auto facet : facets_to_grow_on(lumen, growth.on)) {
    for (int& node : facet) {
      const auto [at, is_new] = number.try_emplace(node, static_cast<int>(surface.nodes.size()));
      if (is_new) surface.nodes.push_back(lumen.nodes[node]);
      node = at->second;
    }
    surface.triangles.push_back(facet);
  }
  std::vector<double> thickness;
  if (options.ratio > 0) {
    thickness = local_radius(surface, options.smoothing);
    if (!std::isfinite(thickness.front()))
      throw InputError(mesh_program, "--thickness-ratio",
                       "is not for this surface: no two places of it face each other, so it has no radius",
                       "give thicknesses: --layer NAME=MM, or --thickness-from");
    for (double& t : thickness) t *= options.ratio;
  } else {
    auto table = read_table(options);
    bring_to_mm(table, {options.unit, options.points_unit});
    thickness = thickness_at(surface, table, options.smoothing);
    if (const auto slip = thickness_slip(surface, thickness); !slip.empty())
      warn(mesh_program, options.file + ": " + slip);
  }
  for (const auto& [node, at] : number) total[node] = thickness[at];
  return total;
}

}  // namespace fsi
