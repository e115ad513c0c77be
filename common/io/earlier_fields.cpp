#include "io/earlier_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>

#include "base/error.hpp"
#include "io/fields_part.hpp"
#include "io/hdf5_file.hpp"
#include "time/time_rounding.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& file, const std::string& dataset, const std::string& problem) {
  throw InputError(file.string(), dataset, problem,
                   "restart from a folder as its run has left it, or continue without fields by --set output.every=0");
}

/// Points that stand behind those of the mesh belong to edges between them (observers/field_output.hpp).
void check_grids(const Hdf5File& h5, const fs::path& file, const std::vector<FieldGrid>& grids) {
  for (const FieldGrid& grid : grids) {
    const std::string points = "/" + grid.name + "/points", cells = "/" + grid.name + "/cells";
    if (!h5.has(points)) continue;  // no field of this medium was wanted
    const auto corners = static_cast<std::uint64_t>(grid.nodes_per_cell);
    const auto shape = h5.shape(points);
    if (!h5.has(cells) || h5.shape(cells) != std::vector<std::uint64_t>{cell_count(grid), corners} ||
        shape.size() != 2 || shape[1] != 3 || shape[0] < point_count(grid))
      refuse(file, grid.name, "is the grid of another mesh");
    const auto stored = grid.stretch
                            ? h5.read_part<double>(points, 3 * grid.stretch->first_point, 3 * grid.points.size())
                            : h5.read<double>(points);
    for (std::size_t i = 0; i < grid.points.size(); ++i)
      if (!std::equal(grid.points[i].begin(), grid.points[i].end(),
                      stored.begin() + static_cast<std::ptrdiff_t>(3 * i)))
        refuse(file, points, "are the points of another mesh");
  }
}

}  // namespace

std::int64_t checked_field_entries(const fs::path& folder, const std::vector<FieldGrid>& grids, double until) {
  std::error_code error;
  std::int64_t entries = 0;
  double last = -1;
  for (std::int64_t part = 0;; ++part) {
    const fs::path file = folder / FieldsPart::name(part);
    if (!fs::exists(file, error)) return entries;
    if (!fs::is_regular_file(file, error)) refuse(file, "", "is no file");
    const auto h5 = Hdf5File::open(file, false);
    check_grids(h5, file, grids);
    const auto numbers = h5.read<std::int64_t>("/steps/number");
    const auto times = h5.read<double>("/steps/time");
    if (times.size() != numbers.size()) refuse(file, "/steps/time", "is not as long as /steps/number");
    std::vector<bool> written(numbers.size());
    for (const std::string& name : h5.members("/steps/written")) {
      const auto flags = h5.read<std::uint8_t>("/steps/written/" + name);
      if (flags.size() != numbers.size()) refuse(file, "/steps/written/" + name, "is not as long as /steps/number");
      const auto dot = name.find('.');
      if (dot == std::string::npos) refuse(file, "/steps/written/" + name, "is unknown");
      const std::string grid = name.substr(0, dot), points = "/" + grid + "/points";
      if (!h5.has(points)) refuse(file, points, "missing");
      const auto nodes = h5.shape(points).at(0), cells = h5.shape("/" + grid + "/cells").at(0);
      for (std::size_t i = 0; i < flags.size(); ++i) {
        if (flags[i] == 0) continue;
        written[i] = true;
        const auto dataset = field_dataset(grid, name.substr(dot + 1), numbers[i]);
        if (!h5.has(dataset)) refuse(file, dataset, "missing, though marked as written");
        const auto shape = h5.shape(dataset);
        if (shape.empty() || shape.size() > 2 || (shape[0] != nodes && shape[0] != cells) ||
            (shape.size() == 2 && shape[1] != 3 && shape[1] != 6))
          refuse(file, dataset, "has another shape than the grid's points and cells");
      }
    }
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (!(times[i] > last) || !std::isfinite(times[i]) || (i > 0 && numbers[i] <= numbers[i - 1]))
        refuse(file, "/steps/time", fmt::format("holds {:g} behind {:g}: entries are out of order", times[i], last));
      last = times[i];
      if (written[i] && times[i] <= until * (1 + time_rounding)) ++entries;
    }
  }
}

void require_no_lost_fields(const fs::path& folder, const std::vector<std::string>& wanted, double until) {
  std::error_code error;
  for (std::int64_t part = 0; fs::exists(folder / FieldsPart::name(part), error); ++part) {
    const fs::path file = folder / FieldsPart::name(part);
    const auto h5 = Hdf5File::open(file, false);
    const auto times = h5.read<double>("/steps/time");
    for (const std::string& name : h5.members("/steps/written")) {
      if (std::find(wanted.begin(), wanted.end(), name) != wanted.end()) continue;
      const auto flags = h5.read<std::uint8_t>("/steps/written/" + name);
      for (std::size_t i = 0; i < std::min(flags.size(), times.size()); ++i)
        if (flags[i] != 0 && times[i] <= until * (1 + time_rounding))
          throw InputError(file.string(), name, "is a field that this restart does not write, and would remove",
                           "ask for it in output.fields, or continue in another folder: -o DIR");
    }
  }
}

}  // namespace fsi
