#include "fields/field_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "base/names.hpp"
#include "fields/field_units.hpp"
#include "fields/point_table.hpp"
#include "fields/vtk_file.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr const char* field_kinds = "give a table of points, .csv, or a field of VTK, .vtu or .vtp";
constexpr const char* surface_kinds = "give a surface of triangles: .vtp or .stl";
constexpr int vtk_triangle = 5, vtk_polygon = 7, vtk_tetrahedron = 10;

FieldSamples samples_of(const VtkMesh& mesh, const std::string& field, const std::string& file) {
  std::vector<std::string> names;
  const VtkMesh::Array* found = nullptr;
  for (const auto& array : mesh.arrays) {
    if (!array.of_numbers) continue;
    if (array.name == field && found == nullptr) found = &array;
    names.push_back(array.name);
  }
  if (found == nullptr)
    throw InputError(file, "field", "\"" + field + "\" is none of its fields",
                     names.empty() ? "give a file with a field" : "give " + one_of(names));
  if (found->components != 1)
    throw InputError(file, "field", fmt::format("\"{}\" has {} components", field, found->components),
                     "give a field with one number at each place");
  FieldSamples samples;
  samples.values = found->values;
  samples.nodes = mesh.nodes;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto& cell = mesh.cells[c];
    if (found->of_cells) {
      Point centre{0, 0, 0};
      for (const int node : cell) centre = centre + (1.0 / static_cast<double>(cell.size())) * mesh.nodes[node];
      samples.places.push_back(centre);
    }
    if (mesh.kinds[c] == vtk_tetrahedron && cell.size() == 4)
      samples.cells.push_back({cell[0], cell[1], cell[2], cell[3]});
    else if ((mesh.kinds[c] == vtk_triangle || mesh.kinds[c] == vtk_polygon) && cell.size() == 3)
      samples.cells.push_back({cell[0], cell[1], cell[2], -1});
    else
      continue;
    if (found->of_cells) samples.place_of_cell.push_back(static_cast<int>(c));
  }
  if (!found->of_cells) samples.places = mesh.nodes;
  if (samples.values.size() != samples.places.size() || samples.values.empty())
    throw InputError(file, "field",
                     fmt::format("\"{}\" has {} values for {} {}", field, samples.values.size(), samples.places.size(),
                                 found->of_cells ? "cells" : "points"),
                     "write the file anew");
  return samples;
}

PaintedSurface of_text_stl(const std::string& text, const std::string& file) {
  PaintedSurface surface;
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    if (word != "vertex") continue;
    Point x;
    if (!(in >> x[0] >> x[1] >> x[2])) throw InputError(file, "", "is cut off", surface_kinds);
    surface.nodes.push_back(x);
  }
  if (surface.nodes.size() % 3 != 0) throw InputError(file, "", "is cut off", surface_kinds);
  return surface;
}

PaintedSurface of_binary_stl(const std::string& text, const std::string& file) {
  constexpr std::size_t head = 84, each = 50;
  std::uint32_t count = 0;
  if (text.size() >= head) std::memcpy(&count, text.data() + 80, 4);
  if (text.size() < head || text.size() < head + each * std::size_t{count})
    throw InputError(file, "", "is cut off", surface_kinds);
  PaintedSurface surface;
  for (std::size_t t = 0; t < count; ++t)
    for (int corner = 0; corner < 3; ++corner) {
      float x[3];
      std::memcpy(x, text.data() + head + each * t + 12 + 12 * static_cast<std::size_t>(corner), sizeof(x));
      surface.nodes.push_back({x[0], x[1], x[2]});
    }
  return surface;
}

}  // namespace

std::string text_of_file(const std::filesystem::path& file, const std::string& kinds) {
  require_regular_file(file, {"no such file", kinds.c_str(), kinds.c_str(), std::uintmax_t{1} << 32});
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw InputError(file.string(), "", "cannot be read", "check its permissions");
  return text.str();
}

FieldSamples read_field_samples(const std::filesystem::path& file, const std::string& field) {
  UnitsOfFile unused;
  return read_field_samples(file, field, unused);
}

FieldSamples read_field_samples(const std::filesystem::path& file, const std::string& field, UnitsOfFile& units) {
  const std::string name = file.string(), kind = file.extension().string();
  if (kind != ".csv" && kind != ".vtu" && kind != ".vtp")
    throw InputError(name, "", kind.empty() ? "has no extension" : "the extension " + kind + " is unknown",
                     field_kinds);
  const std::string text = text_of_file(file, field_kinds);
  if (kind != ".csv") {
    const auto wanted = [&](const VtkMesh::Array& array) { return array.name == field && array.components == 1; };
    return samples_of(read_vtk(text, name, wanted), field, name);
  }
  FieldSamples samples;
  auto table = point_table(text, field, name, "give a number");
  samples.places = std::move(table.places);
  samples.values = std::move(table.values);
  units = {table.length_unit, table.unit};
  return samples;
}

PaintedSurface read_painted_surface(const std::filesystem::path& file) {
  const std::string name = file.string(), kind = file.extension().string();
  if (kind != ".stl" && kind != ".vtp")
    throw InputError(name, "", kind.empty() ? "has no extension" : "the extension " + kind + " is unknown",
                     surface_kinds);
  const std::string text = text_of_file(file, surface_kinds);
  PaintedSurface surface;
  if (kind == ".vtp") {
    const VtkMesh mesh = read_vtk(text, name, [](const VtkMesh::Array&) { return false; });
    surface.nodes = mesh.nodes;
    for (const auto& cell : mesh.cells)
      for (std::size_t k = 2; k < cell.size(); ++k) surface.triangles.push_back({cell[0], cell[k - 1], cell[k]});
  } else {
    const bool is_text = text.rfind("solid", 0) == 0 && text.find("facet") != std::string::npos;
    surface = is_text ? of_text_stl(text, name) : of_binary_stl(text, name);
    for (int node = 0; node + 2 < static_cast<int>(surface.nodes.size()); node += 3)
      surface.triangles.push_back({node, node + 1, node + 2});
  }
  if (surface.triangles.empty()) throw InputError(name, "", "holds no triangles", surface_kinds);
  return surface;
}

}  // namespace fsi
