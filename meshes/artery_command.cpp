#include "meshes/artery_command.hpp"

#include <memory>
#include <optional>
#include <string>

#include "base/output_file.hpp"
#include "host/threads.hpp"
#include "meshes/artery_request.hpp"
#include "meshes/mesh_report.hpp"

namespace fsi {

namespace {

struct TubeRequest {
  std::string level = "coarse";
  std::optional<double> size, axial_size;
  ArteryRequest artery;
  MeshOutput output;
};

/// The options of `fsi-mesh artery`.
void add_options(CLI::App& artery, TubeRequest& request) {
  auto& asked = request.artery;
  auto& shape = asked.sizes;
  add_output_options(artery, request.output);

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
}

/// The level's sizes unless others are given.
void set_sizes(TubeRequest& request) {
  const auto level = artery_level(request.level);
  auto& sizes = request.artery.sizes;
  sizes.size = request.size.value_or(level.size);
  if (!request.size) sizes.axial_size = level.axial_size;
  if (request.axial_size) sizes.axial_size = request.axial_size;
}

void make(TubeRequest& request) {
  set_sizes(request);
  require_known_extension(request.output.file);
  set_threads(request.output.threads);
  regular_output_file(request.output.file);  // before anything is computed
  const auto made = make_artery(request.artery);
  const auto* recommended = request.output.quiet ? nullptr : recommendation(request.artery);
  // The stretched elements of a recommended mesh are meant, and measured.
  write_and_report(made, request.output, TriangleGeometry::axisymmetric, recommended ? to_text(*recommended) : "",
                   !recommended);
}

}  // namespace

MeshCommand artery_command(CLI::App& app) {
  auto* options = app.add_subcommand("artery", "A straight two-layer artery along the z axis from (0,0,0)");
  const auto request = std::make_shared<TubeRequest>();
  add_options(*options, *request);
  return {options, [request] { make(*request); }};
}

}  // namespace fsi
