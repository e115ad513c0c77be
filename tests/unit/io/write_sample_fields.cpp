// Writes into the folder given as argument steps 0 and 8 of three planned ones, and into its folder `series` a series of
// 259 entries in two files: quadratic cells, fields of nodes and cells, scalars, vectors and symmetric tensors. Its writer
// ends without notice behind entry 200, and another one goes on from entry 150, as after a restart from a checkpoint.

#include <filesystem>
#include <vector>

#include "run/program.hpp"
#include "sample_fields.hpp"

namespace {

using fsi::FieldGrid;

constexpr int series_entries = 259;
constexpr double series_step = 0.25;  // ms

/// A quadratic tetrahedron and a quadratic triangle on corners of the unit cube, middles of edges in VTK's order.
std::vector<FieldGrid> series_grids() {
  FieldGrid fluid;
  fluid.name = "fluid";
  fluid.nodes_per_cell = 10;
  fluid.points = {{0, 0, 0},     {1, 0, 0},   {0, 1, 0},   {0, 0, 1},     {0.5, 0, 0},
                  {0.5, 0.5, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  fluid.cells = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  fluid.fields = {{"pressure", 1, "kPa"}, {"traction", 3, "kPa", true}, {"rate", 6, "1/ms"}};
  FieldGrid wall;
  wall.name = "wall";
  wall.nodes_per_cell = 6;
  wall.points = {{0, 0, 0},   {1, 0, 0}, {0, 1, 0},   {0.5, 0, 0}, {0.5, 0.5, 0},
                 {0, 0.5, 0}, {1, 1, 0}, {1, 0.5, 0}, {0.5, 1, 0}};
  wall.cells = {0, 1, 2, 3, 4, 5, 1, 6, 2, 7, 8, 4};
  wall.layer = {2, 3};
  wall.fields = {{"mises", 1, "kPa", true}, {"stress", 6, "kPa", true}, {"displacement", 3, "mm"}};
  return {fluid, wall};
}

/// Value k (place by place, the components side by side) of a field at a time: k + 1000 t.
fsi::FieldValues series_values(const std::vector<FieldGrid>& grids, double time) {
  fsi::FieldValues values;
  for (const auto& grid : grids)
    for (const auto& field : grid.fields) {
      auto& data = values[{grid.name, field.name}];
      data.resize(fsi::places_of(grid, field) * static_cast<std::size_t>(field.components));
      for (std::size_t k = 0; k < data.size(); ++k) data[k] = static_cast<double>(k) + 1000 * time;
    }
  return values;
}

void write_series(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto grids = series_grids();
  const auto plan = fsi::planned_field_steps(series_entries - 1, 1, fsi::test::steps_of(series_step));
  {
    fsi::FieldsWriter first(folder, grids, plan);
    for (int step = 0; step <= 150; ++step) first.write(step, series_values(grids, series_step * step));
    for (int step = 151; step <= 200; ++step) first.write(step, series_values(grids, -1));
  }
  fsi::FieldsWriter second(folder, grids, plan, folder, 150 * series_step);
  for (int step = 151; step < series_entries; ++step) second.write(step, series_values(grids, series_step * step));
}

}  // namespace

int main(int, char** argv) {
  return fsi::run_program(argv[0], [&] {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    const auto grids = fsi::test::sample_grids();
    fsi::FieldsWriter writer(folder, grids, fsi::planned_field_steps(16, 8, fsi::test::steps_of(0.125)));
    writer.write(0, fsi::test::sample_values(grids, 0.0));
    writer.write(8, fsi::test::sample_values(grids, 1.0));
    write_series(folder / "series");
    return 0;
  });
}
