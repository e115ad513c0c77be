#include "io/result_folder.hpp"

#include <array>
#include <cassert>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.hpp"
#include "base/finite.hpp"
#include "io/atomic_file.hpp"
#include "io/energy_table.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

constexpr double pascal_per_kilopascal = 1000.0;

struct Table {
  const char* file;
  const char* header;
  bool of_steps = false;  ///< its rows are of steps, not of levels
};
constexpr const char* energy_file = "energy.csv";  // its columns depend on the scene
constexpr Table centerline_table{"centerline_pressure.csv", "time_ms,z_mm,pressure_Pa"};
constexpr Table wall_table{"wall_displacement.csv", "time_ms,z_mm,radial_mm,axial_mm"};
constexpr Table flow_table{"flow.csv",
                           "time_ms,inlet_flow_mm3_per_ms,outlet_flow_mm3_per_ms,inlet_pressure_Pa,outlet_pressure_Pa"};
constexpr Table iterations_table{"iterations.csv",
                                 "step,time_ms,outer_iterations,newton_iterations,linear_iterations,wall_s,"
                                 "solver_error",
                                 true};
constexpr Table coupling_table{
    "coupling.csv",
    "step,time_ms,iterations,failed_passes,relaxation,columns,displacement_residual,displacement_residual_mm,"
    "force_residual,fluid_newton_iterations,wall_newton_iterations,fluid_linear_iterations,wall_linear_iterations,"
    "fluid_s,wall_s,mesh_motion_s,coupling_s,pressure_residual",
    true};

/// Everything a run leaves in its folder; a folder with nothing else may be emptied for a new run.
constexpr std::array<const char*, 11> result_files = {
    centerline_table.file, wall_table.file, flow_table.file, iterations_table.file,
    coupling_table.file,   energy_file,     "summary.json",  "fields.h5",
    "fields.xdmf",         "checkpoint.h5", "run.log"};

bool is_result_file(const fs::path& name) {
  for (const auto* file : result_files)
    if (name == file || name == temporary_name(file)) return true;
  return false;
}

std::vector<Table> tables_of(const ResultTables& wanted) {
  std::vector<Table> tables{iterations_table};
  if (wanted.centerline_pressure) tables.push_back(centerline_table);
  if (wanted.wall_displacement) tables.push_back(wall_table);
  if (wanted.flow) tables.push_back(flow_table);
  if (wanted.coupling) tables.push_back(coupling_table);
  return tables;
}

/// Creates the folder where needed and checks that files can be created in it, before hours are computed.
void prepare(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(folder.string(), "", "is a file", "give a folder to -o");
  fs::create_directories(folder, error);
  if (error)
    throw InputError(folder.string(), "", "cannot be created (" + error.message() + ")",
                     "give -o a folder that you may write");
  const auto probe = temporary_name(folder / "summary.json");
  if (!std::ofstream(probe))
    throw InputError(folder.string(), "", "cannot be written", "give -o a folder that you may write");
  fs::remove(probe, error);
}

/// The results of an earlier run make way; anything else in the folder is not ours to delete.
void remove_old_results(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!is_result_file(entry.path().filename()) || entry.is_directory(error))
      throw InputError(folder.string(), "", "holds '" + entry.path().filename().string() + "', which is no result file",
                       "give -o a new folder, or one with nothing but the results of an earlier run");
    old.push_back(entry.path());
  }
  if (error)
    throw InputError(folder.string(), "", "cannot be read (" + error.message() + ")", "give -o another folder");
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

/// \throws ConvergenceError before anything is written when a number is not finite
void write_rows(CsvFile& file, const std::string& name, const std::vector<std::vector<double>>& rows) {
  for (const auto& row : rows) require_finite(row, "a number of " + name);
  file.write(rows);
}

}  // namespace

void require_no_results(const fs::path& folder, const std::string& go_on) {
  const auto row = last_row(folder / iterations_table.file);
  if (row.size() < 2) return;
  const std::string status = summary_text(folder, "status"), program = summary_text(folder, "program");
  const std::string what = "run" + (program.empty() ? "" : " of " + program), steps = row[0] + " steps";
  if (status == "done")
    throw InputError(folder.string(), "", "holds a finished " + what + " (" + steps + ")",
                     "give -o another folder, or replace it with --force");
  std::error_code error;
  const bool saved = fs::exists(folder / "checkpoint.h5", error);
  throw InputError(
      folder.string(), "",
      "holds an unfinished " + what + " (status \"" + (status.empty() ? "unknown" : status) + "\", " + steps + ")",
      (saved ? "continue it with " + go_on + ", " : "") + "give -o another folder, or replace it with --force");
}

ResultFolder::ResultFolder(fs::path folder, const ResultTables& tables) : folder_(std::move(folder)) {
  prepare(folder_);
  remove_old_results(folder_);
  open_tables(tables, false);
}

ResultFolder::ResultFolder(fs::path folder, const ResultTables& tables, const fs::path& from, double time,
                           double observed)
    : folder_(std::move(folder)) {
  std::error_code error;
  if (!fs::is_directory(from, error))
    throw InputError(from.string(), "", "is no folder", "give --restart the result folder of an earlier run");
  prepare(folder_);
  if (!fs::equivalent(folder_, from, error)) remove_old_results(folder_);
  for (const auto& table : tables_of(tables))
    copy_csv_until(from / table.file, folder_ / table.file, table.header, table.of_steps ? time : observed);
  if (tables.energy) {
    if (!fs::exists(from / energy_file, error))
      throw InputError((from / energy_file).string(), "output.energy", "is wanted, but the earlier run wrote none",
                       "continue with --set output.energy=false");
    copy_csv_until(from / energy_file, folder_ / energy_file, energy_header(*tables.energy), time);
  }
  open_tables(tables, true);
}

void ResultFolder::open_tables(const ResultTables& tables, bool append) {
  const auto open = [&](std::optional<CsvFile>& place, const Table& table) {
    place.emplace(folder_ / table.file, table.header, append);
  };
  open(iterations_, iterations_table);
  if (tables.centerline_pressure) open(centerline_, centerline_table);
  if (tables.wall_displacement) open(wall_, wall_table);
  if (tables.flow) open(flow_, flow_table);
  if (tables.coupling) open(coupling_, coupling_table);
  energy_parts_ = tables.energy;
  if (energy_parts_) energy_.emplace(folder_ / energy_file, energy_header(*energy_parts_), append);
}

void ResultFolder::write_centerline(double time, const std::vector<double>& z, const std::vector<double>& pressure) {
  assert(pressure.size() == z.size());
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < z.size(); ++i) rows.push_back({time, z[i], pascal_per_kilopascal * pressure.at(i)});
  write_rows(*centerline_, centerline_table.file, rows);
}

void ResultFolder::write_wall(double time, const std::vector<double>& z, const std::vector<double>& radial,
                              const std::vector<double>& axial) {
  assert(radial.size() == z.size() && axial.size() == z.size());
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < z.size(); ++i) rows.push_back({time, z[i], radial.at(i), axial.at(i)});
  write_rows(*wall_, wall_table.file, rows);
}

void ResultFolder::write_flow(double time, const FlowRecord& flow) {
  write_rows(*flow_, flow_table.file,
             {{time, flow.inlet_flow, flow.outlet_flow, pascal_per_kilopascal * flow.inlet_pressure,
               pascal_per_kilopascal * flow.outlet_pressure}});
}

void ResultFolder::write_iterations(const StepRecord& record) {
  write_rows(*iterations_, iterations_table.file,
             {{static_cast<double>(record.step), record.time, static_cast<double>(record.outer_iterations),
               static_cast<double>(record.newton_iterations), static_cast<double>(record.linear_iterations),
               record.wall_seconds, record.solver_error}});
}

void ResultFolder::write_coupling(const StepRecord& record, const CouplingReport& c) {
  const auto number = [](auto count) { return static_cast<double>(count); };
  write_rows(*coupling_, coupling_table.file,
             {{number(record.step), record.time, number(record.outer_iterations), number(c.failed_passes), c.relaxation,
               number(c.columns), c.displacement_residual, c.displacement_gap, c.force_residual,
               number(c.fluid_newton_iterations), number(c.wall_newton_iterations), number(c.fluid_linear_iterations),
               number(c.wall_linear_iterations), c.fluid_seconds, c.wall_seconds, c.mesh_seconds, c.algebra_seconds,
               c.pressure_residual}});
}

void ResultFolder::write_energy(const StepRecord& record, const EnergyRecord& energy) {
  write_rows(*energy_, energy_file,
             {energy_row(energy_parts_.value(), static_cast<int>(record.step), record.time, energy)});
}

}  // namespace fsi
