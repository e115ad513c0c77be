#include "io/result_folder.hpp"

#include <algorithm>
#include <cassert>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.hpp"
#include "base/finite.hpp"
#include "base/output_file.hpp"
#include "io/atomic_file.hpp"
#include "io/energy_table.hpp"
#include "io/fields_part.hpp"
#include "io/folder_lock.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

/// Everything a run leaves in its folder; a folder with nothing else may be emptied for a new run.
const std::vector<std::string>& result_files() {
  static const std::vector<std::string> files = [] {
    std::vector<std::string> names{"summary.json", "fields.h5",     "fields.xdmf",  "fluid.xdmf",
                                   "wall.xdmf",    "checkpoint.h5", "prestress.h5", "run.log"};
    for (const ResultTable& table : tables_of({true, true, true, true, EnergyParts(), {"any"}, {"any"}}))
      names.push_back(table.file);
    names.insert(names.end(), {points_file, lines_file, planes_file});
    return names;
  }();
  return files;
}

/// What a row of a step begins with.
std::vector<double> lead(const StepRecord& record) {
  return {static_cast<double>(record.step), record.time};
}

bool is_result_file(const fs::path& name) {
  const auto& files = result_files();
  return std::any_of(files.begin(), files.end(),
                     [&](const std::string& file) { return name == file || name == temporary_name(file); }) ||
         FieldsPart::number_of(name.extension() == ".tmp" ? name.stem() : name).has_value();
}

/// Creates the folder where needed and checks that files can be created in it, before hours are computed.
void prepare(const fs::path& folder) {
  make_folder(folder);
  std::error_code error;
  const auto probe = temporary_name(folder / "summary.json");
  if (!std::ofstream(probe))
    throw InputError(folder.string(), "", "cannot be written", "give -o a folder that you may write");
  fs::remove(probe, error);
}

/// The results of an earlier run make way; anything else in the folder is not ours to delete.
void remove_old_results(const fs::path& folder) {
  require_results_only(folder);
  std::error_code error;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (is_result_file(entry.path().filename())) old.push_back(entry.path());
  for (const auto& file : old) {
    fs::remove(file, error);
    if (error)
      throw InputError(file.string(), "", "cannot be replaced (" + error.message() + ")",
                       "give -o a folder that you may write");
  }
}

/// The last whole line of a table, its values as text; empty when it has none.
std::vector<std::string> last_row(const fs::path& file) {
  std::ifstream stream(file);
  std::string line, last;
  std::getline(stream, line);  // header
  while (std::getline(stream, line) && !stream.eof()) last = line;
  std::vector<std::string> cells;
  std::istringstream words(last);
  for (std::string cell; std::getline(words, cell, ',');) cells.push_back(cell);
  return cells;
}

/// An entry of summary.json that is text; empty when there is none.
std::string summary_text(const fs::path& folder, const char* key) {
  std::ifstream stream(folder / "summary.json");
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  if (!json.is_object() || !json.contains(key) || !json[key].is_string()) return {};
  return json[key].get<std::string>();
}

/// What speaks of finished steps in a folder whose table of steps has no row; empty: nothing does. A run that was ended
/// in its first step leaves tables with their headers, and fields of the start.
std::string results_without_steps(const fs::path& folder, const std::string& status) {
  std::error_code error;
  if (status == "done") return "a finished run";
  if (fs::exists(folder / "checkpoint.h5", error)) return "a checkpoint";
  std::ifstream steps(folder / iterations_table().file);
  std::string header;
  if (steps && (!std::getline(steps, header) || header == iterations_table().header)) return {};
  for (const auto& file : result_files())
    if (file != "run.log" && file != "summary.json" && fs::exists(folder / file, error)) return file;
  return {};
}

}  // namespace

void require_results_only(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error)) throw InputError(folder.string(), "", "is a file", "give a folder to -o");
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto name = entry.path().filename();
    if (name == lock_name) continue;
    if (!is_result_file(name))
      throw InputError(folder.string(), "", "holds '" + name.string() + "', which is no result file",
                       "give -o a new folder, or one with nothing but the results of an earlier run");
    require_regular_or_absent(entry.path(), false);
  }
  if (error)
    throw InputError(folder.string(), "", "cannot be read (" + error.message() + ")", "give -o another folder");
}

void require_regular_results(const fs::path& folder, bool follow) {
  for (const auto& file : result_files()) {
    require_regular_or_absent(folder / file, follow);
    require_regular_or_absent(temporary_name(folder / file), follow);
  }
}

void require_no_results(const fs::path& folder, const std::string& go_on) {
  std::error_code error;
  const auto row = last_row(folder / iterations_table().file);
  const std::string status = summary_text(folder, "status"), program = summary_text(folder, "program");
  const bool saved = fs::exists(folder / "checkpoint.h5", error);
  if (row.size() < 2) {
    const auto found = results_without_steps(folder, status);
    if (found.empty()) return;
    throw InputError(folder.string(), "",
                     "holds " + found + ", but no " + iterations_table().file + " with their steps",
                     "give -o another folder, or replace what is there with --force");
  }
  const std::string what = "run" + (program.empty() ? "" : " of " + program), steps = row[0] + " steps";
  if (status == "done")
    throw InputError(folder.string(), "", "holds a finished " + what + " (" + steps + ")",
                     "give -o another folder, or replace it with --force");
  throw InputError(
      folder.string(), "",
      "holds an unfinished " + what + " (status \"" + (status.empty() ? "unknown" : status) + "\", " + steps + ")",
      (saved ? "continue it with " + go_on + ", " : "") + "give -o another folder, or replace it with --force");
}

ResultFolder::ResultFolder(fs::path folder, const ResultTables& tables, FirstProcess& first)
    : first_(&first), folder_(std::move(folder)) {
  first_->now([&] {
    prepare(folder_);
    remove_old_results(folder_);
  });
  open_tables(tables, false);
}

ResultFolder::ResultFolder(fs::path folder, const ResultTables& tables, const EarlierTables& earlier,
                           FirstProcess& first)
    : first_(&first), folder_(std::move(folder)) {
  first_->now([&] {
    prepare(folder_);
    std::error_code error;
    if (!fs::equivalent(folder_, earlier.folder(), error)) remove_old_results(folder_);
    earlier.copy_to(folder_);
  });
  open_tables(tables, true);
}

void ResultFolder::open_tables(const ResultTables& tables, bool append) {
  opening_names_ = tables.openings;
  energy_parts_ = tables.energy;
  const auto open = [&](std::optional<CsvFile>& place, const ResultTable& table) {
    place.emplace(folder_ / table.file, table.header, append);
  };
  first_->now([&] {
    open(iterations_, iterations_table());
    if (tables.centerline_pressure) open(centerline_, centerline_table());
    if (tables.wall_displacement) open(wall_, wall_table());
    if (tables.flow) open(flow_, flow_table());
    if (!opening_names_.empty()) open(openings_, openings_table(opening_names_));
    if (tables.coupling) open(coupling_, coupling_table());
    if (energy_parts_) open(energy_, energy_table(*energy_parts_));
    if (!tables.surfaces.empty()) open(surfaces_, surfaces_table(tables.surfaces));
    for (const SampledTable& table : tables.sampled)
      sampled_.try_emplace(table.file, folder_ / table.file, table.header, append);
    for (const ResultTable& table : tables_of(tables)) digests_.emplace(table.file, TableDigest(folder_ / table.file));
  });
}

/// \throws ConvergenceError before anything is written when a number is not finite
void ResultFolder::write(std::optional<CsvFile>& table, const std::string& name, const Rows& rows,
                         const std::vector<std::string>& names) {
  for (const auto& row : rows) require_finite(row, "a number of " + name);
  first_->later([&] { table.value().write(rows, names); });
}

void ResultFolder::take_digests() {
  first_->later([&] {
    for (auto& [file, digest] : digests_) digest.take();
  });
}

TableDigests ResultFolder::digests() const {
  TableDigests numbers;
  for (const auto& [file, digest] : digests_) numbers[file] = digest.numbers();
  return numbers;
}

void ResultFolder::write_centerline(double time, const std::vector<CentrePoint>& points) {
  write(centerline_, centerline_table().file, rows_of({time}, centreline_columns(), points));
}

void ResultFolder::write_wall(double time, const std::vector<WallPoint>& points) {
  write(wall_, wall_table().file, rows_of({time}, wall_columns(), points));
}

void ResultFolder::write_sampled(const SampledTable& table, double time, const std::vector<SampledRow>& rows) {
  const std::string text = sampled_text(table, time, rows);
  first_->later([&] { sampled_.at(table.file).write_text(text); });
}

void ResultFolder::write_flow(double time, const FlowRecord& flow) {
  write(flow_, flow_table().file, {row_of({time}, flow_columns(), flow)});
}

void ResultFolder::write_openings(double time, const std::vector<OpeningRecord>& openings) {
  write(openings_, openings_table({}).file, rows_of({time}, opening_columns(), openings), opening_names_);
}

void ResultFolder::write_iterations(const StepRecord& record) {
  write(iterations_, iterations_table().file, {row_of(lead(record), iteration_columns(), record)});
}

void ResultFolder::write_coupling(const StepRecord& record, const CouplingReport& report) {
  const CouplingRecord coupling{static_cast<int>(record.outer_iterations), report};
  write(coupling_, coupling_table().file, {row_of(lead(record), coupling_columns(), coupling)});
}

void ResultFolder::write_energy(const StepRecord& record, const EnergyRecord& energy) {
  const EnergyParts& parts = energy_parts_.value();
  write(energy_, energy_table(parts).file, {row_of(lead(record), energy_columns(parts), energy)});
}

void ResultFolder::write_surfaces(double time, const std::vector<SurfaceRecord>& surfaces) {
  std::vector<std::string> names;
  for (const SurfaceRecord& s : surfaces) names.push_back(s.surface);
  write(surfaces_, surfaces_table({}).file, rows_of({time}, surface_columns(), surfaces), names);
}

void ResultFolder::close() {
  first_->agree();
  first_->now([&] {
    for (auto* table : {&centerline_, &wall_, &flow_, &openings_, &iterations_, &coupling_, &energy_, &surfaces_})
      if (*table) (*table)->close();
    for (auto& [file, table] : sampled_) table.close();
  });
}

}  // namespace fsi
