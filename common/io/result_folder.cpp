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
#include "base/output_file.hpp"
#include "io/atomic_file.hpp"
#include "io/fields_part.hpp"
#include "io/folder_lock.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

constexpr const char* begin_of_steps = "step,time_ms,";  // of a table with a row for each step

/// Everything that a run leaves in its folder but further parts of fields.h5; `tables` are among it.
std::vector<std::string> result_files(const std::vector<std::string>& tables) {
  std::vector<std::string> names{"summary.json", "fields.h5",     "fields.xdmf",  "fluid.xdmf",
                                 "wall.xdmf",    "checkpoint.h5", "prestress.h5", "run.log"};
  names.insert(names.end(), tables.begin(), tables.end());
  return names;
}

bool is_result_file(const fs::path& name, const std::vector<std::string>& tables) {
  const auto files = result_files(tables);
  return std::any_of(files.begin(), files.end(),
                     [&](const std::string& file) { return name == file || name == temporary_name(file); }) ||
         FieldsPart::number_of(name.extension() == ".tmp" ? name.stem() : name).has_value();
}

/// Creates the folder if needed and checks that files can be created in it, before anything is computed.
void prepare(const fs::path& folder) {
  make_folder(folder);
  std::error_code error;
  const auto probe = temporary_name(folder / "summary.json");
  if (!std::ofstream(probe))
    throw InputError(folder.string(), "", "cannot be written", "give -o a folder that you may write");
  fs::remove(probe, error);
}

/// Removes the results of an earlier run; refuses a folder with anything else.
void remove_old_results(const fs::path& folder, const std::vector<std::string>& tables) {
  require_results_only(folder, tables);
  std::error_code error;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (is_result_file(entry.path().filename(), tables)) old.push_back(entry.path());
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

/// The sign of finished steps in a folder whose table of steps has no row; empty: none. A run that ended in its first
/// step leaves tables with headers only, and fields of the start.
std::string results_without_steps(const fs::path& folder, const std::vector<std::string>& tables,
                                  const std::string& status) {
  std::error_code error;
  if (status == "done") return "a finished run";
  if (fs::exists(folder / "checkpoint.h5", error)) return "a checkpoint";
  std::ifstream steps(folder / iterations_file);
  std::string header;
  if (steps && (!std::getline(steps, header) || header.rfind(begin_of_steps, 0) == 0)) return {};
  for (const auto& file : result_files(tables))
    if (file != "run.log" && file != "summary.json" && fs::exists(folder / file, error)) return file;
  return {};
}

}  // namespace

void require_results_only(const fs::path& folder, const std::vector<std::string>& tables) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error)) throw InputError(folder.string(), "", "is a file", "give a folder to -o");
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto name = entry.path().filename();
    if (name == lock_name) continue;
    if (!is_result_file(name, tables))
      throw InputError(folder.string(), "", "holds '" + name.string() + "', which is no result file",
                       "give -o a new folder, or one with nothing but the results of an earlier run");
    require_regular_or_absent(entry.path(), false);
  }
  if (error)
    throw InputError(folder.string(), "", "cannot be read (" + error.message() + ")", "give -o another folder");
}

void require_regular_results(const fs::path& folder, const std::vector<std::string>& tables, bool follow) {
  for (const auto& file : result_files(tables)) {
    require_regular_or_absent(folder / file, follow);
    require_regular_or_absent(temporary_name(folder / file), follow);
  }
}

void require_no_results(const fs::path& folder, const std::vector<std::string>& tables, const std::string& go_on) {
  std::error_code error;
  const auto row = last_row(folder / iterations_file);
  const std::string status = summary_text(folder, "status"), program = summary_text(folder, "program");
  const bool saved = fs::exists(folder / "checkpoint.h5", error);
  if (row.size() < 2) {
    const auto found = results_without_steps(folder, tables, status);
    if (found.empty()) return;
    throw InputError(folder.string(), "", "holds " + found + ", but no " + iterations_file + " with their steps",
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

ResultFolder::ResultFolder(fs::path folder, const std::vector<ResultTable>& tables,
                           const std::vector<std::string>& known, FirstProcess& first)
    : first_(&first), folder_(std::move(folder)) {
  first_->now([&] {
    prepare(folder_);
    remove_old_results(folder_, known);
  });
  open_tables(tables, false);
}

ResultFolder::ResultFolder(fs::path folder, const std::vector<ResultTable>& tables,
                           const std::vector<std::string>& known, const EarlierTables& earlier, FirstProcess& first)
    : first_(&first), folder_(std::move(folder)) {
  first_->now([&] {
    prepare(folder_);
    std::error_code error;
    if (!fs::equivalent(folder_, earlier.folder(), error)) remove_old_results(folder_, known);
    earlier.copy_to(folder_);
  });
  open_tables(tables, true);
}

void ResultFolder::open_tables(const std::vector<ResultTable>& tables, bool append) {
  for (const ResultTable& table : tables) tables_.push_back({table, {}, {}});
  first_->now([&] {
    for (auto& [table, file, digest] : tables_) file.emplace(folder_ / table.file, table.header, append);
    for (auto& [table, file, digest] : tables_) digest.emplace(folder_ / table.file);
  });
}

void ResultFolder::write(const TableRows& rows) {
  const auto open =
      std::find_if(tables_.begin(), tables_.end(), [&](const Open& o) { return o.table.file == rows.file; });
  assert(open != tables_.end());
  const std::string text = text_of(open->table, rows);
  first_->later([&] { open->file.value().write(text); });
}

void ResultFolder::take_digests() {
  first_->later([&] {
    for (Open& open : tables_) open.digest.value().take();
  });
}

TableDigests ResultFolder::digests() const {
  TableDigests numbers;
  for (const Open& open : tables_)
    if (open.digest) numbers[open.table.file] = open.digest->numbers();
  return numbers;
}

void ResultFolder::close() {
  first_->agree();
  first_->now([&] {
    for (Open& open : tables_) open.file.value().close();
  });
}

}  // namespace fsi
