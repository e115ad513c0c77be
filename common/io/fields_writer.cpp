#include "io/fields_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "base/error.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/xdmf.hpp"

namespace fsi {

namespace fs = std::filesystem;

// Layout of fields.h5, all datasets contiguous:
//   /GRID/points (N, 3) double, mm      /GRID/cells (M, 3, 4, 6 or 10) int32      /GRID/layer (M) int32
//   /GRID/FIELD/STEP (N) or (N, 3) double, STEP with eight digits; attribute `unit` on /GRID/FIELD
//   /steps/number (S) int64   /steps/time (S) double, ms
//   /steps/written/GRID.FIELD (S) uint8: 1 once the values of that step are on disk

namespace {

std::string flags_dataset(const std::string& grid, const std::string& field) {
  return "/steps/written/" + grid + "." + field;
}

}  // namespace

namespace {

/// Whether time a comes after b by more than rounding.
bool later(double a, double b) {
  return a - b > 1e-9 * std::max(std::abs(a), std::abs(b));
}

}  // namespace

struct FieldsWriter::Implementation {
  using Flags = std::vector<std::uint8_t>;

  fs::path h5, xdmf;
  std::vector<FieldGrid> grids;
  std::vector<FieldStep> steps;                                  ///< ascending
  std::map<std::pair<std::string, std::string>, Flags> written;  ///< per (grid, field) and step

  Implementation(const fs::path& folder, std::vector<FieldGrid> grids_, std::vector<FieldStep> planned)
      : h5(folder / "fields.h5"), xdmf(folder / "fields.xdmf"), grids(std::move(grids_)), steps(std::move(planned)) {
    for (const auto& grid : grids) {
      assert(grid.nodes_per_cell > 0 && grid.cells.size() % grid.nodes_per_cell == 0);
      assert(grid.layer.empty() || grid.layer.size() * grid.nodes_per_cell == grid.cells.size());
      assert(std::all_of(grid.cells.begin(), grid.cells.end(), [&](std::int32_t node) {
        return node >= 0 && static_cast<std::size_t>(node) < grid.points.size();
      }));
      for (const auto& field : grid.fields) written[{grid.name, field.name}].assign(steps.size(), 0);
    }
  }

  /// Position of a step, steps.size() when it is not planned.
  std::size_t position(std::int64_t step) const {
    assert(std::is_sorted(steps.begin(), steps.end(),
                          [](const FieldStep& a, const FieldStep& b) { return a.step < b.step; }));
    const auto found = std::lower_bound(steps.begin(), steps.end(), step,
                                        [](const FieldStep& entry, std::int64_t s) { return entry.step < s; });
    return found == steps.end() || found->step != step ? steps.size() : static_cast<std::size_t>(found - steps.begin());
  }

  /// All datasets of all steps, with the flags as they stand.
  void create_datasets(Hdf5File& file) const {
    for (const auto& grid : grids) {
      const std::uint64_t n = grid.points.size(), corners = static_cast<std::uint64_t>(grid.nodes_per_cell);
      const auto prefix = "/" + grid.name;
      file.write_new<double>(prefix + "/points", {n, 3}, n == 0 ? nullptr : grid.points.front().data());
      file.write_new<std::int32_t>(prefix + "/cells", {grid.cells.size() / corners, corners}, grid.cells.data());
      if (!grid.layer.empty()) file.write_new<std::int32_t>(prefix + "/layer", {grid.layer.size()}, grid.layer.data());
      for (const auto& field : grid.fields) {
        std::vector<std::uint64_t> shape{n};
        if (field.components > 1) shape.push_back(static_cast<std::uint64_t>(field.components));
        for (const auto& step : steps)
          file.create_dataset<double>(field_dataset(grid.name, field.name, step.step), shape);
        if (!steps.empty()) file.write_attribute(prefix + "/" + field.name, "unit", field.unit);
        file.write_new<std::uint8_t>(flags_dataset(grid.name, field.name), {steps.size()},
                                     written.at({grid.name, field.name}).data());
      }
    }
    std::vector<std::int64_t> numbers;
    std::vector<double> times;
    for (const auto& step : steps) {
      numbers.push_back(step.step);
      times.push_back(step.time);
    }
    file.write_new<std::int64_t>("/steps/number", {steps.size()}, numbers.data());
    file.write_new<double>("/steps/time", {steps.size()}, times.data());
  }

  void write_xdmf() const {
    std::vector<FinishedStep> finished;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      FinishedStep step{steps[i], {}};
      for (const auto& [name, flags] : written)
        if (flags[i] != 0) step.fields.push_back(name);
      if (!step.fields.empty()) finished.push_back(step);
    }
    write_atomically(xdmf, xdmf_text(grids, finished));
  }

  void create() const {
    auto file = Hdf5File::create(temporary_name(h5));
    create_datasets(file);
    file.close();
    replace_by_temporary(h5);
    write_xdmf();
  }

  void require_same_grids(const Hdf5File& old, const fs::path& old_path) const {
    for (const auto& grid : grids) {
      const auto points = "/" + grid.name + "/points", cells = "/" + grid.name + "/cells";
      const std::uint64_t corners = static_cast<std::uint64_t>(grid.nodes_per_cell);
      if (!old.has(points) || !old.has(cells))
        throw InputError(old_path.string(), grid.name, "no grid of this name", "restart from a run of the same scene");
      if (old.shape(points) != std::vector<std::uint64_t>{grid.points.size(), 3} ||
          old.shape(cells) != std::vector<std::uint64_t>{grid.cells.size() / corners, corners})
        throw InputError(old_path.string(), grid.name,
                         fmt::format("has {} points, not {}", old.shape(points).at(0), grid.points.size()),
                         "restart from a run on the same mesh");
    }
  }

  /// Takes over the finished entries of an earlier fields.h5 up to the time `until`. The new file is made beside the old one
  /// and replaces it complete.
  void continue_from(const fs::path& old_path, double until) {
    const auto old = Hdf5File::open(old_path, false);
    require_same_grids(old, old_path);
    const auto old_numbers = old.read<std::int64_t>("/steps/number");
    const auto old_times = old.read<double>("/steps/time");
    std::map<std::pair<std::string, std::string>, Flags> old_written;
    for (const auto& [name, flags] : written) {
      auto& taken = old_written[name];
      if (old.has(flags_dataset(name.first, name.second)))
        taken = old.read<std::uint8_t>(flags_dataset(name.first, name.second));
      taken.resize(old_numbers.size(), 0);
    }

    // What is kept comes first, then what is planned behind it.
    std::vector<FieldStep> all;
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < old_numbers.size(); ++i) {
      const bool any =
          std::any_of(old_written.begin(), old_written.end(), [&](const auto& w) { return w.second[i] != 0; });
      if (!any || later(old_times.at(i), until)) continue;
      kept.push_back(i);
      all.push_back({old_numbers[i], old_times.at(i)});
    }
    for (auto step : steps) {
      if (!later(step.time, until)) continue;
      if (!all.empty()) step.step = std::max(step.step, all.back().step + 1);
      all.push_back(step);
    }
    steps = std::move(all);
    for (auto& [name, flags] : written) {
      flags.assign(steps.size(), 0);
      for (std::size_t k = 0; k < kept.size(); ++k) flags[k] = old_written[name][kept[k]];
    }

    // An XDMF file that is here already must not list, in between, entries that the new file has lost.
    std::error_code error;
    if (fs::exists(h5, error) && fs::equivalent(old_path, h5, error)) write_xdmf();
    auto file = Hdf5File::create(temporary_name(h5));
    create_datasets(file);
    for (const auto& [name, flags] : written)
      for (std::size_t k = 0; k < kept.size(); ++k) {
        if (flags[k] == 0) continue;
        const auto dataset = field_dataset(name.first, name.second, steps[k].step);
        file.write(dataset, old.read<double>(dataset).data());
      }
    file.close();
    replace_by_temporary(h5);
    write_xdmf();
  }

  void write(std::int64_t step, const FieldValues& values) {
    const auto i = position(step);
    if (i == steps.size()) throw std::logic_error(fmt::format("step {} of fields.h5 was not planned", step));
    auto file = Hdf5File::open(h5, true);
    for (const auto& grid : grids)
      for (const auto& field : grid.fields) {
        const auto& data = values.at({grid.name, field.name});
        if (data.size() != grid.points.size() * static_cast<std::size_t>(field.components))
          throw std::logic_error(grid.name + "." + field.name + " has the wrong number of values");
        file.write(field_dataset(grid.name, field.name, step), data.data());
      }
    file.flush();  // the values before the flags that vouch for them
    for (auto& [name, flags] : written) {
      flags[i] = 1;
      file.write(flags_dataset(name.first, name.second), flags.data());
    }
    file.close();
    write_xdmf();
  }
};

std::vector<FieldStep> planned_field_steps(std::int64_t last_step, std::int64_t every,
                                           const std::function<double(std::int64_t)>& time_of) {
  std::vector<FieldStep> steps;
  if (every <= 0) return steps;
  for (std::int64_t step = 0; step <= last_step; step += every) steps.push_back({step, time_of(step)});
  if (steps.back().step != last_step) steps.push_back({last_step, time_of(last_step)});
  return steps;
}

FieldsWriter::FieldsWriter(const fs::path& folder, std::vector<FieldGrid> grids, std::vector<FieldStep> planned)
    : self_(std::make_unique<Implementation>(folder, std::move(grids), std::move(planned))) {
  self_->create();
}

FieldsWriter::FieldsWriter(const fs::path& folder, std::vector<FieldGrid> grids, std::vector<FieldStep> planned,
                           const fs::path& from, double until)
    : self_(std::make_unique<Implementation>(folder, std::move(grids), std::move(planned))) {
  std::error_code error;
  if (fs::exists(from / "fields.h5", error))
    self_->continue_from(from / "fields.h5", until);
  else
    self_->create();
}

FieldsWriter::~FieldsWriter() = default;
FieldsWriter::FieldsWriter(FieldsWriter&&) noexcept = default;
FieldsWriter& FieldsWriter::operator=(FieldsWriter&&) noexcept = default;

bool FieldsWriter::wants(std::int64_t step) const {
  return self_->position(step) < self_->steps.size();
}

std::optional<std::int64_t> FieldsWriter::entry_at(double time) const {
  for (const FieldStep& step : self_->steps)
    if (!later(step.time, time) && !later(time, step.time)) return step.step;
  return {};
}

void FieldsWriter::write(std::int64_t step, const FieldValues& values) {
  self_->write(step, values);
}

}  // namespace fsi
