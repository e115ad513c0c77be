#include "io/fields_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "io/atomic_file.hpp"
#include "io/fields_part.hpp"
#include "io/first_process.hpp"
#include "io/write_error.hpp"
#include "io/xdmf.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

/// Whether time a comes after b by more than rounding.
bool later(double a, double b) {
  return a - b > 1e-9 * std::max(std::abs(a), std::abs(b));
}

[[maybe_unused]] bool is_sound(const FieldGrid& grid) {
  return grid.nodes_per_cell > 0 && grid.cells.size() % grid.nodes_per_cell == 0 &&
         (grid.layer.empty() || grid.layer.size() * grid.nodes_per_cell == grid.cells.size()) &&
         std::all_of(grid.cells.begin(), grid.cells.end(), [&](std::int32_t node) {
           return node >= 0 && static_cast<std::uint64_t>(node) < point_count(grid);
         });
}

/// The entries of an earlier run up to the time of a restart.
struct Kept {
  /// An entry that is moved to another part.
  struct Moved {
    FieldsPart::Source source;
    std::int64_t part;
  };
  std::vector<WrittenEntry> entries;  ///< those of whole parts first
  std::int64_t whole = 0;             ///< parts of which every entry is kept
  std::vector<Moved> moved;           ///< one for each entry behind these parts
};

/// \param until  ms, of the last entry that is kept
Kept kept_of(const fs::path& folder, const std::vector<FieldGrid>& grids, double until) {
  Kept kept;
  std::error_code error;
  for (std::int64_t part = 0; fs::exists(folder / FieldsPart::name(part), error); ++part) {
    const auto file = folder / FieldsPart::name(part);
    const auto all = FieldsPart::entries_of(file, grids);
    std::vector<WrittenEntry> found;
    for (const auto& entry : all) {
      const auto& before = found.empty() ? kept.entries : found;
      // A restart that was killed may have left an entry in two parts.
      const bool known = !before.empty() && !later(entry.step.time, before.back().step.time);
      if (any(entry.fields) && !known && !later(entry.step.time, until)) found.push_back(entry);
    }
    const bool whole = all.size() == static_cast<std::size_t>(FieldsPart::capacity) && found.size() == all.size();
    if (whole && kept.whole == part)
      ++kept.whole;
    else
      for (const auto& entry : found) kept.moved.push_back({{file, entry.fields}, part});
    kept.entries.insert(kept.entries.end(), found.begin(), found.end());
  }
  return kept;
}

}  // namespace

struct FieldsWriter::Implementation {
  fs::path folder;
  std::vector<FieldGrid> grids;
  FieldPlan plan;
  std::vector<FieldStep> kept;  ///< of an earlier run; then comes the plan from its entry first_planned on
  std::int64_t first_planned = 0;
  std::vector<XdmfDocument> documents;  ///< of all media, then of each
  std::int64_t parts = 0;               ///< on disk
  std::int64_t open_part = -1;
  std::optional<FieldsPart> part;
  const Communicator& processes;

  Implementation(fs::path folder_, std::vector<FieldGrid> grids_, FieldPlan plan_, const Communicator& processes_)
      : folder(std::move(folder_)), grids(std::move(grids_)), plan(std::move(plan_)), processes(processes_) {
    documents.emplace_back(folder / "fields.xdmf", grids);
    for (std::size_t medium = 0; medium < grids.size(); ++medium)
      documents.emplace_back(folder / (grids[medium].name + ".xdmf"), grids, medium);
    assert(std::all_of(grids.begin(), grids.end(), is_sound));
  }

  std::int64_t kept_count() const { return static_cast<std::int64_t>(kept.size()); }
  std::int64_t total() const { return kept_count() + plan.entries - first_planned; }
  FieldStep entry(std::int64_t i) const {
    const std::int64_t further = i - kept_count();
    if (further < 0) return kept[static_cast<std::size_t>(i)];
    FieldStep step = plan.at(first_planned + further);
    if (!kept.empty()) step.step = std::max(step.step, kept.back().step + 1 + further);
    return step;
  }

  /// Position of the entry with a number, total() if there is none.
  std::int64_t position(std::int64_t step) const {
    const auto found = first_that(total(), [&](std::int64_t i) { return entry(i).step >= step; });
    return found < total() && entry(found).step == step ? found : total();
  }
  /// Position of the entry at a time, likewise.
  std::int64_t position_at(double time) const {
    const auto found = first_that(total(), [&](std::int64_t i) { return !later(time, entry(i).time); });
    return found < total() && !later(entry(found).time, time) ? found : total();
  }

  fs::path file_of(std::int64_t number) const { return folder / FieldsPart::name(number); }

  /// Makes a part under its temporary name.
  void prepare(std::int64_t number, const std::vector<FieldsPart::Source>& sources) const {
    std::vector<FieldStep> steps;
    const std::int64_t first = number * FieldsPart::capacity;
    for (std::int64_t i = first; i < std::min(total(), first + FieldsPart::capacity); ++i) steps.push_back(entry(i));
    FieldsPart::prepare(file_of(number), grids, steps, sources, processes);
  }

  /// Makes the documents with the first `count` entries.
  void list(std::int64_t count, const std::function<ListedEntry(std::int64_t)>& entry_of) {
    at_first(processes, [&] {
      for (auto& document : documents) document.replace(count, entry_of, total());
    });
  }

  void create() {
    prepare(0, {});
    at_first(processes, [&] { replace_by_temporary(file_of(0)); });
    parts = 1;
    list(0, nullptr);
  }

  void continue_from(const fs::path& from, double until) {
    Kept old;
    do_together(processes, [&] { old = kept_of(from, grids, until); });
    for (const auto& found : old.entries) kept.push_back(found.step);
    first_planned = first_that(plan.entries, [&](std::int64_t i) { return later(plan.at(i).time, until); });
    const auto listed = [&](std::int64_t i) {
      return ListedEntry{old.entries[static_cast<std::size_t>(i)], FieldsPart::name(i / FieldsPart::capacity)};
    };
    std::error_code error;
    const bool in_place = fs::exists(folder, error) && fs::equivalent(from, folder, error);
    // In between, the lists in this folder must not have entries that their files have lost.
    if (in_place) list(old.whole * FieldsPart::capacity, listed);
    if (!in_place) at_first(processes, [&] { copy_whole_parts(from, old.whole); });
    move_entries(old);
    at_first(processes, [&] { remove_others(); });
    list(kept_count(), listed);
  }

  void copy_whole_parts(const fs::path& from, std::int64_t count) const {
    std::error_code error;
    for (std::int64_t number = 0; number < count; ++number) {
      fs::copy_file(from / FieldsPart::name(number), temporary_name(file_of(number)),
                    fs::copy_options::overwrite_existing, error);
      if (error) {
        remove_temporary(file_of(number));
        throw WriteError(file_of(number), error.value());
      }
      replace_by_temporary(file_of(number));
    }
  }

  /// Removes what an earlier run has left behind the last part.
  void remove_others() const {
    std::vector<fs::path> others;
    for (const auto& found : fs::directory_iterator(folder)) {
      const auto name = found.path().filename();
      const bool temporary = name.extension() == ".tmp";
      const auto number = FieldsPart::number_of(temporary ? name.stem() : name);
      if (number && (temporary || *number >= parts)) others.push_back(found.path());
    }
    for (const auto& file : others) fs::remove(file);
  }

  /// Makes the parts behind those that are whole, as far as they have entries; one at least.
  void move_entries(const Kept& old) {
    parts = old.whole;
    bool downwards = false;  // whether an entry comes into a later part than it was in
    const auto moved = static_cast<std::int64_t>(old.moved.size());
    for (std::int64_t first = 0; first < moved || parts == 0; first += FieldsPart::capacity, ++parts) {
      std::vector<FieldsPart::Source> sources;
      for (std::int64_t i = first; i < std::min(moved, first + FieldsPart::capacity); ++i) {
        const auto& of_entry = old.moved[static_cast<std::size_t>(i)];
        sources.push_back(of_entry.source);
        downwards = downwards || parts > of_entry.part;
      }
      prepare(parts, sources);
    }
    // In such an order that after a kill in between each entry is in at least one part.
    at_first(processes, [&] {
      for (std::int64_t k = 0; k < parts - old.whole; ++k)
        replace_by_temporary(file_of(downwards ? parts - 1 - k : old.whole + k));
    });
  }

  /// Opens a part, which is made if it is the next one.
  FieldsPart& opened(std::int64_t number) {
    for (; parts <= number; ++parts) {
      prepare(parts, {});
      at_first(processes, [&] { replace_by_temporary(file_of(parts)); });
    }
    if (open_part != number) {
      part.emplace(file_of(number), grids, processes);
      open_part = number;
    }
    return *part;
  }

  void write(std::int64_t step, const FieldValues& values) {
    const auto i = position(step);
    if (i == total()) throw std::logic_error(fmt::format("step {} of fields.h5 was not planned", step));
    std::vector<std::vector<const std::vector<double>*>> arrays;
    for (const auto& grid : grids) {
      auto& of_grid = arrays.emplace_back();
      for (const auto& field : grid.fields) {
        const auto& data = values.at({grid.name, field.name});
        if (data.size() != places_here(grid, field) * static_cast<std::size_t>(field.components))
          throw std::logic_error(grid.name + "." + field.name + " has the wrong number of values");
        of_grid.push_back(&data);
      }
    }
    const std::int64_t number = i / FieldsPart::capacity, place = i % FieldsPart::capacity;
    FieldsPart& file = opened(number);
    const bool listed = any(file.fields_of(place));
    file.write(place, arrays);
    if (listed) return;
    const ListedEntry finished{{entry(i), file.fields_of(place)}, FieldsPart::name(number)};
    at_first(processes, [&] {
      for (auto& document : documents) document.add(finished);
    });
  }
};

FieldsWriter::FieldsWriter(const fs::path& folder, std::vector<FieldGrid> grids, FieldPlan plan,
                           const Communicator& processes)
    : self_(std::make_unique<Implementation>(folder, std::move(grids), std::move(plan), processes)) {
  self_->create();
}

FieldsWriter::FieldsWriter(const fs::path& folder, std::vector<FieldGrid> grids, FieldPlan plan, const fs::path& from,
                           double until, const Communicator& processes)
    : self_(std::make_unique<Implementation>(folder, std::move(grids), std::move(plan), processes)) {
  std::error_code error;
  if (fs::exists(from / FieldsPart::name(0), error))
    self_->continue_from(from, until);
  else
    self_->create();
}

FieldsWriter::~FieldsWriter() = default;
FieldsWriter::FieldsWriter(FieldsWriter&&) noexcept = default;
FieldsWriter& FieldsWriter::operator=(FieldsWriter&&) noexcept = default;

std::optional<std::int64_t> FieldsWriter::entry_at(double time) const {
  const auto found = self_->position_at(time);
  if (found == self_->total()) return {};
  return self_->entry(found).step;
}

void FieldsWriter::write(std::int64_t step, const FieldValues& values) {
  self_->write(step, values);
}

}  // namespace fsi
