#include "io/fields_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cstring>
#include <limits>

#include "base/error.hpp"
#include "io/atomic_file.hpp"
#include "io/first_process.hpp"
#include "io/hdf5_file.hpp"
#include "io/stretch_writer.hpp"

namespace fsi {

namespace fs = std::filesystem;

// Layout, all datasets contiguous:
//   /GRID/points (N, 3) double, mm      /GRID/cells (M, 3, 4, 6 or 10) int32      /GRID/layer (M) int32
//   /GRID/FIELD/STEP (N), (N, 3) or (N, 6) double, M instead of N for a field of cells; STEP with eight digits;
//   attribute `unit` on /GRID/FIELD
//   /steps/number (S) int64   /steps/time (S) double, ms
//   /steps/written/GRID.FIELD (S) uint8: 1 once the values of that step are on disk

namespace {

constexpr const char* stem = "fields";
constexpr const char* suffix = ".h5";

std::string flags_dataset(const FieldGrid& grid, const FieldDescription& field) {
  return "/steps/written/" + grid.name + "." + field.name;
}

/// One flag for each field of the grids, all zero.
FieldFlags no_fields(const std::vector<FieldGrid>& grids) {
  FieldFlags flags;
  for (const auto& grid : grids) flags.emplace_back(grid.fields.size(), std::uint8_t{0});
  return flags;
}

void require_same_grids(const Hdf5File& old, const fs::path& file, const std::vector<FieldGrid>& grids) {
  for (const auto& grid : grids) {
    const auto points = "/" + grid.name + "/points", cells = "/" + grid.name + "/cells";
    const auto corners = static_cast<std::uint64_t>(grid.nodes_per_cell);
    if (!old.has(points) || !old.has(cells))
      throw InputError(file.string(), grid.name, "no grid of this name", "restart from a run of the same scene");
    if (old.shape(points) != std::vector<std::uint64_t>{point_count(grid), 3} ||
        old.shape(cells) != std::vector<std::uint64_t>{cell_count(grid), corners})
      throw InputError(file.string(), grid.name,
                       fmt::format("has {} points, not {}", old.shape(points).at(0), point_count(grid)),
                       "restart from a run on the same mesh");
  }
}

std::vector<WrittenEntry> read_entries(const Hdf5File& file, const fs::path& path,
                                       const std::vector<FieldGrid>& grids) {
  const auto refuse = [&](const std::string& dataset) {
    throw InputError(path.string(), dataset, "has another length than /steps/number",
                     "the file is damaged; run from the start, or restart without fields: --set output.every=0");
  };
  const auto numbers = file.read<std::int64_t>("/steps/number");
  const auto times = file.read<double>("/steps/time");
  if (times.size() != numbers.size()) refuse("/steps/time");
  std::vector<WrittenEntry> entries;
  for (std::size_t i = 0; i < numbers.size(); ++i) entries.push_back({{numbers[i], times[i]}, no_fields(grids)});
  for (std::size_t g = 0; g < grids.size(); ++g)
    for (std::size_t f = 0; f < grids[g].fields.size(); ++f) {
      const auto dataset = flags_dataset(grids[g], grids[g].fields[f]);
      if (!file.has(dataset)) continue;
      const auto flags = file.read<std::uint8_t>(dataset);
      if (flags.size() != numbers.size()) refuse(dataset);
      for (std::size_t i = 0; i < flags.size(); ++i) entries[i].fields[g][f] = flags[i];
    }
  return entries;
}

[[noreturn]] void refuse_other_number(const fs::path& file, const std::string& dataset) {
  throw InputError(file.string(), dataset, "has another number of values than the grid asks for",
                   "the file is damaged; run from the start, or restart without fields: "
                   "--set output.every=0");
}

}  // namespace

bool any(const FieldFlags& flags) {
  return std::any_of(flags.begin(), flags.end(), [](const auto& of_grid) {
    return std::any_of(of_grid.begin(), of_grid.end(), [](std::uint8_t flag) { return flag != 0; });
  });
}

std::string field_dataset(const std::string& grid, const std::string& field, std::int64_t step) {
  return fmt::format("/{}/{}/{:08}", grid, field, step);
}

std::string FieldsPart::name(std::int64_t part) {
  return part == 0 ? fmt::format("{}{}", stem, suffix) : fmt::format("{}-{:04}{}", stem, part + 1, suffix);
}

std::optional<std::int64_t> FieldsPart::number_of(const std::string& file) {
  if (file == name(0)) return 0;
  const std::size_t digits = std::strlen(stem) + 1;  // where they begin
  std::int64_t part = 0;
  for (std::size_t i = digits; i < file.size() && std::isdigit(static_cast<unsigned char>(file[i])) != 0; ++i)
    if (part < std::numeric_limits<std::int64_t>::max() / 10 - 9) part = 10 * part + (file[i] - '0');
  if (part >= 2 && file == name(part - 1)) return part - 1;
  return {};
}

void FieldsPart::prepare(const fs::path& path, const std::vector<FieldGrid>& grids,
                         const std::vector<FieldStep>& entries, const std::vector<Source>& sources,
                         const Communicator& processes) {
  try {
    at_first(processes, [&] { make(path, grids, entries, sources, processes.is_alone()); });
    if (!processes.is_alone()) do_together(processes, [&] { fill(path, grids, entries, sources, processes); });
  } catch (...) {
    if (processes.is_first()) remove_temporary(path);
    throw;
  }
}

void FieldsPart::make(const fs::path& path, const std::vector<FieldGrid>& grids, const std::vector<FieldStep>& entries,
                      const std::vector<Source>& sources, bool with_values) {
  assert(sources.size() <= entries.size());
  auto file = Hdf5File::create(temporary_name(path));
  for (std::size_t g = 0; g < grids.size(); ++g) {
    const FieldGrid& grid = grids[g];
    const std::uint64_t n = point_count(grid), cells = cell_count(grid),
                        corners = static_cast<std::uint64_t>(grid.nodes_per_cell);
    const auto prefix = "/" + grid.name;
    file.create_dataset<double>(prefix + "/points", {n, 3});
    if (with_values && n > 0) file.write(prefix + "/points", grid.points.front().data());
    file.create_dataset<std::int32_t>(prefix + "/cells", {cells, corners});
    if (with_values) file.write(prefix + "/cells", grid.cells.data());
    if (is_layered(grid)) file.create_dataset<std::int32_t>(prefix + "/layer", {cells});
    if (is_layered(grid) && with_values) file.write(prefix + "/layer", grid.layer.data());
    for (std::size_t f = 0; f < grid.fields.size(); ++f) {
      const FieldDescription& field = grid.fields[f];
      std::vector<std::uint64_t> shape{places_of(grid, field)};
      if (field.components > 1) shape.push_back(static_cast<std::uint64_t>(field.components));
      for (const auto& entry : entries)
        file.create_dataset<double>(field_dataset(grid.name, field.name, entry.step), shape);
      if (!entries.empty()) file.write_attribute(prefix + "/" + field.name, "unit", field.unit);
      std::vector<std::uint8_t> flags(entries.size(), 0);
      for (std::size_t i = 0; i < sources.size(); ++i) flags[i] = sources[i].fields[g][f];
      file.write_new<std::uint8_t>(flags_dataset(grid, field), {flags.size()}, flags.data());
    }
  }
  std::vector<std::int64_t> numbers;
  std::vector<double> times;
  for (const auto& entry : entries) {
    numbers.push_back(entry.step);
    times.push_back(entry.time);
  }
  file.write_new<std::int64_t>("/steps/number", {entries.size()}, numbers.data());
  file.write_new<double>("/steps/time", {entries.size()}, times.data());

  std::optional<Hdf5File> old;
  for (std::size_t i = 0; with_values && i < sources.size(); ++i) {
    if (i == 0 || sources[i].file != sources[i - 1].file) old = Hdf5File::open(sources[i].file, false);
    for (std::size_t g = 0; g < grids.size(); ++g)
      for (std::size_t f = 0; f < grids[g].fields.size(); ++f) {
        if (sources[i].fields[g][f] == 0) continue;
        const auto dataset = field_dataset(grids[g].name, grids[g].fields[f].name, entries[i].step);
        const auto values = old->read<double>(dataset);
        const FieldDescription& field = grids[g].fields[f];
        if (values.size() != places_of(grids[g], field) * static_cast<std::size_t>(field.components))
          refuse_other_number(sources[i].file, dataset);
        file.write(dataset, values.data());
      }
  }
  file.close();
}

/// Writes the values of a part that processes make together, each its stretches: grids, and entries from sources.
void FieldsPart::fill(const fs::path& path, const std::vector<FieldGrid>& grids, const std::vector<FieldStep>& entries,
                      const std::vector<Source>& sources, const Communicator& processes) {
  StretchWriter writer(temporary_name(path), path, processes);
  for (const FieldGrid& grid : grids) {
    const FieldGrid::Stretch& here = grid.stretch.value();
    std::vector<double> points;
    for (const Point& point : grid.points) points.insert(points.end(), point.begin(), point.end());
    writer.write("/" + grid.name + "/points", 3 * here.first_point, points);
    writer.write("/" + grid.name + "/cells", here.first_cell * static_cast<std::uint64_t>(grid.nodes_per_cell),
                 std::vector<std::int32_t>(grid.cells.begin(), grid.cells.end()));
    if (here.layered)
      writer.write("/" + grid.name + "/layer", here.first_cell,
                   std::vector<std::int32_t>(grid.layer.begin(), grid.layer.end()));
  }
  std::optional<Hdf5File> old;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (i == 0 || sources[i].file != sources[i - 1].file) old = Hdf5File::open(sources[i].file, false);
    for (std::size_t g = 0; g < grids.size(); ++g)
      for (std::size_t f = 0; f < grids[g].fields.size(); ++f) {
        if (sources[i].fields[g][f] == 0) continue;
        const FieldDescription& field = grids[g].fields[f];
        const auto dataset = field_dataset(grids[g].name, field.name, entries[i].step);
        const auto components = static_cast<std::uint64_t>(field.components);
        std::uint64_t size = 1;
        for (const auto extent : old->shape(dataset)) size *= extent;
        if (size != places_of(grids[g], field) * components) refuse_other_number(sources[i].file, dataset);
        const std::uint64_t first = first_place(grids[g], field) * components;
        writer.write(dataset, first, old->read_part<double>(dataset, first, places_here(grids[g], field) * components));
      }
  }
  writer.close();
}

std::vector<WrittenEntry> FieldsPart::entries_of(const fs::path& path, const std::vector<FieldGrid>& grids) {
  const auto file = Hdf5File::open(path, false);
  require_same_grids(file, path, grids);
  return read_entries(file, path, grids);
}

FieldsPart::FieldsPart(const fs::path& path, const std::vector<FieldGrid>& grids, const Communicator& processes)
    : processes_(&processes), file_(path) {
  const auto file = Hdf5File::open(path, false);
  const auto entries = read_entries(file, path, grids);
  for (const auto& entry : entries) flags_.push_back(entry.fields);
  for (const auto& grid : grids) {
    auto& of_grid = places_.emplace_back();
    for (const auto& field : grid.fields) {
      auto& of_field = of_grid.emplace_back();
      if (!file.has(flags_dataset(grid, field))) continue;
      of_field.flags = file.place_of(flags_dataset(grid, field));
      of_field.first = first_place(grid, field) * static_cast<std::uint64_t>(field.components);
      for (const auto& entry : entries) {
        const auto dataset = field_dataset(grid.name, field.name, entry.step.step);
        of_field.values.push_back(file.place_of(dataset));
        if (grid.stretch) of_field.datasets.push_back(dataset);
      }
    }
  }
}

void FieldsPart::write(std::int64_t place, const std::vector<std::vector<const std::vector<double>*>>& values) {
  if (processes_->is_alone()) {
    write_values(place, values);
  } else {
    at_first(*processes_, [&] { file_.open().close(); });  // refuses a file that was removed or replaced
    do_together(*processes_, [&] { write_stretches(place, values); });
    at_first(*processes_, [&] { write_flags(place); });
  }
  for (std::size_t g = 0; g < places_.size(); ++g)
    for (std::size_t f = 0; f < places_[g].size(); ++f)
      if (!places_[g][f].values.empty()) flags_[static_cast<std::size_t>(place)][g][f] = 1;
}

void FieldsPart::write_values(std::int64_t place, const std::vector<std::vector<const std::vector<double>*>>& values) {
  const auto i = static_cast<std::size_t>(place);
  auto file = file_.open();
  for (std::size_t g = 0; g < places_.size(); ++g)
    for (std::size_t f = 0; f < places_[g].size(); ++f)
      if (const Places& at = places_[g][f]; !at.values.empty())
        file.write(at.values.at(i), values[g][f]->data(), sizeof(double) * values[g][f]->size());
  file.sync();
  write_flags(file, i);
  file.close();
}

void FieldsPart::write_stretches(std::int64_t place,
                                 const std::vector<std::vector<const std::vector<double>*>>& values) {
  const auto i = static_cast<std::size_t>(place);
  StretchWriter writer(file_.path(), file_.path(), *processes_);
  for (std::size_t g = 0; g < places_.size(); ++g)
    for (std::size_t f = 0; f < places_[g].size(); ++f)
      if (const Places& at = places_[g][f]; !at.values.empty())
        writer.write(at.datasets.at(i), at.first, *values[g][f]);
  writer.close();
}

void FieldsPart::write_flags(std::int64_t place) {
  auto file = file_.open();
  write_flags(file, static_cast<std::size_t>(place));
  file.close();
}

/// Marks the values of an entry as written.
void FieldsPart::write_flags(FileInPlace::Opened& file, std::size_t place) const {
  for (const auto& of_grid : places_)
    for (const Places& at : of_grid) {
      if (at.values.empty()) continue;
      const std::uint8_t written = 1;
      file.write(at.flags + place, &written, 1);
    }
  file.sync();
}

}  // namespace fsi
