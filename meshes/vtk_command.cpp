#include "meshes/vtk_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fields/field_samples.hpp"
#include "fields/vtk_file.hpp"
#include "host/standard_streams.hpp"

namespace fsi {

namespace {

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

bool is_scalar(const VtkMesh::Array& array) {
  return array.of_numbers && array.components == 1;
}

void print_arrays(const std::string& file) {
  const VtkMesh mesh = read_vtk(text_of_file(file, "give a mesh or surface of VTK, .vtu or .vtp"), file, is_scalar);
  std::vector<double> coordinates;
  for (const auto& x : mesh.nodes) coordinates.insert(coordinates.end(), x.begin(), x.end());
  std::vector<std::int64_t> ends, corners;
  for (const auto& cell : mesh.cells) {
    corners.insert(corners.end(), cell.begin(), cell.end());
    ends.push_back(static_cast<std::int64_t>(corners.size()));
  }
  auto fields = nlohmann::json::array(), left_out = nlohmann::json::array();
  std::string numbers;
  for (const auto& array : mesh.arrays) {
    if (!array.of_numbers)
      left_out.push_back(array.name + " (no numbers)");
    else if (array.components != 1)
      left_out.push_back(fmt::format("{} ({} components)", array.name, array.components));
    else if (array.pieces == mesh.pieces) {
      fields.push_back({{"name", array.name}, {"of_cells", array.of_cells}, {"numbers", array.values.size()}});
      numbers += bytes_of(array.values);
    }
  }
  const nlohmann::json head{
      {"points", mesh.nodes.size()}, {"cells", ends.size()},       {"corners", corners.size()}, {"lines", mesh.lines},
      {"strips", mesh.strips},       {"surface", mesh.is_surface}, {"fields", fields},          {"left_out", left_out}};
  print(head.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  print(bytes_of(coordinates) + bytes_of(ends) +
        bytes_of(std::vector<std::int64_t>(mesh.kinds.begin(), mesh.kinds.end())) + bytes_of(corners) + numbers);
}

}  // namespace

MeshCommand vtk_command(CLI::App& app) {
  auto* options = app.add_subcommand("vtk-arrays", "Prints what a file of VTK holds, for fsi-mesh import");
  options->group("");  // not in the help
  const auto file = std::make_shared<std::string>();
  options->add_option("file", *file, "A mesh or surface, .vtu or .vtp")->required();
  return {options, [file] { print_arrays(*file); }};
}

}  // namespace fsi
