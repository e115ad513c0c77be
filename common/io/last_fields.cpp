#include "io/last_fields.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <system_error>

#include "base/error.hpp"
#include "io/fields_part.hpp"
#include "io/hdf5_file.hpp"

namespace fsi {

namespace {

namespace fs = std::filesystem;

/// The number of the last of a run's files of fields.
std::int64_t last_part(const fs::path& run) {
  std::error_code error;
  if (!fs::is_directory(run, error))
    throw InputError(run.string(), "", "is no result folder", "give the folder that a run has made");
  std::int64_t parts = 0;
  while (fs::is_regular_file(run / FieldsPart::name(parts), error)) ++parts;
  if (parts == 0)
    throw InputError(run.string(), "fields.h5", "is not there", "run the case with fields, output.every above 0");
  return parts - 1;
}

/// The dataset of a field's last written entry; empty: there is none.
std::optional<std::string> last_entry(const Hdf5File& h5, const std::string& grid, const std::string& field) {
  const std::string written = "/steps/written/" + grid + "." + field;
  if (!h5.has(written)) return {};
  const auto flags = h5.read<std::uint8_t>(written);
  const auto numbers = h5.read<std::int64_t>("/steps/number");
  for (std::size_t i = std::min(flags.size(), numbers.size()); i-- > 0;)
    if (flags[i] != 0) return field_dataset(grid, field, numbers[i]);
  return {};
}

FieldGrid grid_of_file(const Hdf5File& h5, const fs::path& file, const std::string& name) {
  FieldGrid grid;
  grid.name = name;
  const auto refuse = [&](const std::string& problem) {
    throw InputError(file.string(), name, problem, "give a folder as its run has left it");
  };
  const auto shape = h5.shape("/" + name + "/cells");
  if (shape.size() != 2) refuse("has no table of cells");
  grid.nodes_per_cell = static_cast<int>(shape[1]);
  const auto points = h5.read<double>("/" + name + "/points");
  for (std::size_t i = 0; i + 2 < points.size(); i += 3)
    grid.points.push_back({points[i], points[i + 1], points[i + 2]});
  const auto cells = h5.read<std::int32_t>("/" + name + "/cells");
  grid.cells.assign(cells.begin(), cells.end());
  for (const int node : grid.cells)
    if (node < 0 || static_cast<std::size_t>(node) >= grid.points.size()) refuse("has cells without their nodes");
  return grid;
}

std::vector<LastFields> fields_of(const fs::path& file, const std::vector<std::string>& names) {
  const auto h5 = Hdf5File::open(file, false);
  std::vector<LastFields> found;
  for (const char* grid : {"fluid", "wall"}) {
    LastFields fields{file, {}, {}};
    for (const auto& name : names) {
      const auto dataset = last_entry(h5, grid, name);
      if (!dataset) continue;
      if (fields.values.empty()) fields.grid = grid_of_file(h5, file, grid);
      auto values = h5.read<double>(*dataset);
      if (values.size() != cells_here(fields.grid))
        throw InputError(file.string(), *dataset, "has not one value for each cell",
                         "give a folder as its run has left it");
      fields.values[name] = std::move(values);
    }
    if (!fields.values.empty()) found.push_back(std::move(fields));
  }
  return found;
}

}  // namespace

std::vector<LastFields> last_fields_of_cells(const fs::path& run, const std::vector<std::string>& names) {
  std::int64_t part = last_part(run);
  auto found = fields_of(run / FieldsPart::name(part), names);
  // A run that was killed may have made its last file without writing to it.
  while (found.empty() && part > 0) found = fields_of(run / FieldsPart::name(--part), names);
  return found;
}

}  // namespace fsi
