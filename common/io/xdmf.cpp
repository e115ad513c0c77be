#include "io/xdmf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace fsi {

namespace {

/// XDMF's name of cells with so many nodes.
const char* topology_of(int nodes_per_cell) {
  switch (nodes_per_cell) {
    case 3:
      return "Triangle";
    case 4:
      return "Tetrahedron";
    case 6:
      return "Triangle_6";
    default:
      return "Tetrahedron_10";
  }
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string data_item(const std::string& dimensions, bool is_real, const std::string& dataset) {
  return fmt::format(
      "<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" Format=\"HDF\">fields.h5:{}</DataItem>",
      dimensions, is_real ? "Float" : "Int", is_real ? 8 : 4, dataset);
}

std::string grid_text(const FieldGrid& grid, const FinishedStep& finished) {
  const auto nodes = grid.points.size();
  const auto cells = grid.cells.size() / static_cast<std::size_t>(grid.nodes_per_cell);
  const auto prefix = "/" + grid.name;
  std::string text =
      fmt::format("        <Grid Name=\"step {}\" GridType=\"Uniform\">\n          <Time Value=\"{}\"/>\n",
                  finished.step.step, finished.step.time);
  text += fmt::format("          <Topology TopologyType=\"{}\" NumberOfElements=\"{}\">{}</Topology>\n",
                      topology_of(grid.nodes_per_cell), cells,
                      data_item(fmt::format("{} {}", cells, grid.nodes_per_cell), false, prefix + "/cells"));
  text += fmt::format("          <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
                      data_item(fmt::format("{} 3", nodes), true, prefix + "/points"));
  if (!grid.layer.empty())
    text += fmt::format("          <Attribute Name=\"layer\" AttributeType=\"Scalar\" Center=\"Cell\">{}</Attribute>\n",
                        data_item(fmt::format("{}", cells), false, prefix + "/layer"));
  for (const auto& field : grid.fields) {
    if (std::find(finished.fields.begin(), finished.fields.end(), std::make_pair(grid.name, field.name)) ==
        finished.fields.end())
      continue;
    assert(field.components == 1 || field.components == 3);
    text += fmt::format(
        "          <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\"><Information Name=\"unit\" "
        "Value=\"{}\"/>{}</Attribute>\n",
        escaped(field.name), field.components == 3 ? "Vector" : "Scalar", escaped(field.unit),
        data_item(field.components == 3 ? fmt::format("{} 3", nodes) : fmt::format("{}", nodes), true,
                  field_dataset(grid.name, field.name, finished.step.step)));
  }
  return text + "        </Grid>\n";
}

}  // namespace

std::string field_dataset(const std::string& grid, const std::string& field, std::int64_t step) {
  return fmt::format("/{}/{}/{:08}", grid, field, step);
}

std::string xdmf_text(const std::vector<FieldGrid>& grids, const std::vector<FinishedStep>& finished) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<Xdmf Version=\"2.0\">\n"
      "  <Domain>\n"
      "    <Grid Name=\"media\" GridType=\"Collection\" CollectionType=\"Spatial\">\n";
  for (const auto& grid : grids) {
    text += fmt::format("      <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
                        escaped(grid.name));
    for (const auto& step : finished) text += grid_text(grid, step);
    text += "      </Grid>\n";
  }
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace fsi
