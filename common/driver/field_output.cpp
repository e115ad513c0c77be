#include "driver/field_output.hpp"
#include "fem/nodal_layout.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace fsi {

namespace {

constexpr int n = P1Tetrahedron::components;

FieldGrid grid_of(const std::string& name, const Submesh<3>& part) {
  FieldGrid grid;
  grid.name = name;
  grid.points = part.nodes;
  for (const auto& cell : part.cells) grid.cells.insert(grid.cells.end(), cell.begin(), cell.end());
  grid.layer = part.cell_region;
  return grid;
}

/// `count` numbers per node out of arrays with `stride` numbers per node.
std::vector<double> taken(const std::vector<double>& from, int stride, int first, int count) {
  std::vector<double> to;
  to.reserve(from.size() / stride * count);
  for (std::size_t node = 0; node < from.size() / stride; ++node)
    for (int k = 0; k < count; ++k) to.push_back(from[node * stride + first + k]);
  return to;
}

/// A field of output.fields: which grids have it, and its values.
struct OutputField {
  std::string_view name;
  int components;
  const char* unit;
  bool (*exists)(bool moves, bool flows);
  std::vector<double> (*values)(const State& state, bool fluid);
};

constexpr std::array<OutputField, 3> output_fields{
    {{"displacement", n, "mm", [](bool moves, bool) { return moves; },
      [](const State& state, bool fluid) {
        return fluid ? state.now.mesh : taken(state.now.wall, MixedLayout<n>::entries, 0, n);
      }},
     {"velocity", n, "mm/ms", [](bool, bool flows) { return flows; },
      [](const State& state, bool fluid) {
        return fluid ? taken(state.now.fluid, MixedLayout<n>::entries, 0, n) : state.wall_velocity;
      }},
     {"pressure", 1, "kPa", [](bool, bool) { return true; },
      [](const State& state, bool fluid) {
        return taken(fluid ? state.now.fluid : state.now.wall, MixedLayout<n>::entries, n, 1);
      }}}};
static_assert(names_match(output_field_list, output_fields), "case/choices.hpp owns these names");

}  // namespace

FieldOutput::FieldOutput(const Case& setup, const Scene<P1Tetrahedron>& scene, const TimeAxis& axis,
                         const std::filesystem::path& folder, const std::filesystem::path& restarted_from,
                         int first_step)
    : scene_(scene) {
  if (setup.output.every == 0 || setup.output.fields.empty()) return;
  const auto& wanted = setup.output.fields;
  const auto describe = [&](FieldGrid grid, bool moves, bool flows) {
    for (const auto& field : output_fields)
      if (std::find(wanted.begin(), wanted.end(), field.name) != wanted.end() && field.exists(moves, flows))
        grid.fields.push_back({std::string(field.name), field.components, field.unit});
    if (!grid.fields.empty()) grids_.push_back(std::move(grid));
  };
  if (scene.fluid) describe(grid_of("fluid", scene.fluid->part()), scene.coupled(), true);
  if (scene.wall) describe(grid_of("wall", scene.wall->part()), true, !scene.is_static());
  if (grids_.empty()) return;
  const auto planned = planned_field_steps(axis.steps(), setup.output.every,
                                           [&](std::int64_t step) { return axis.time_of(static_cast<int>(step)); });
  if (restarted_from.empty())
    writer_ = std::make_unique<FieldsWriter>(folder, grids_, planned);
  else
    writer_ = std::make_unique<FieldsWriter>(folder, grids_, planned, restarted_from, first_step);
}

void FieldOutput::write(const State& state) {
  if (!writer_ || !writer_->wants(state.step)) return;
  FieldValues values;
  for (const auto& grid : grids_)
    for (const auto& field : grid.fields)
      for (const auto& known : output_fields)
        if (known.name == field.name) values[{grid.name, field.name}] = known.values(state, grid.name == "fluid");
  writer_->write(state.step, values);
}

}  // namespace fsi
