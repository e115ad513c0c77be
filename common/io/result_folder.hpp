#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "diagnostics/energy_record.hpp"
#include "io/csv_file.hpp"
#include "io/earlier_tables.hpp"
#include "io/first_process.hpp"
#include "io/level_columns.hpp"
#include "io/result_tables.hpp"
#include "io/step_columns.hpp"

namespace fsi {

/// Refuses a new run in a folder that holds results of finished steps: whether that run is finished or not, whether its
/// summary can be read or not, they are worth the time they took. A folder whose run has not come to the end of a step
/// may be used again.
/// \param go_on  the command that continues a run in this folder
/// \throws InputError that says what the folder holds and how to go on
void require_no_results(const std::filesystem::path& folder, const std::string& go_on);

/// Refuses a new run in a folder that holds anything but the regular files of a run: those make way, others are not
/// ours to delete. \throws InputError
void require_results_only(const std::filesystem::path& folder);

/// Refuses a folder in which the name of a result file is that of something else, such as a folder, a pipe or a device.
/// \param follow  whether a symbolic link counts as what it leads to: for reading, not for writing
/// \throws InputError
void require_regular_results(const std::filesystem::path& folder, bool follow);

/// The folder of one run and its CSV tables, each row on disk when its step is done. Of several processes the first one
/// writes: the others have a folder of this class, too, to which they hand over the same rows.
class ResultFolder {
 public:
  /// A new run. Creates the folder; one that holds nothing but result files is emptied.
  /// \throws InputError when the folder holds anything else, or cannot be created or written
  /// \param first  tells the processes, which make and close the folder together, of rows that could not be written;
  ///               must outlive this
  ResultFolder(std::filesystem::path folder, const ResultTables& tables, FirstProcess& first = FirstProcess::alone());

  /// Continues a run whose tables have been checked: they are copied, or in place cut behind its checkpoint.
  /// \throws InputError as above
  ResultFolder(std::filesystem::path folder, const ResultTables& tables, const EarlierTables& earlier,
               FirstProcess& first = FirstProcess::alone());

  const std::filesystem::path& path() const { return folder_; }

  /// Rows of the level at `time`, ms.
  void write_centerline(double time, const std::vector<CentrePoint>& points);
  void write_wall(double time, const std::vector<WallPoint>& points);
  /// \param rows  as many as the table has places
  void write_sampled(const SampledTable& table, double time, const std::vector<SampledRow>& rows);
  void write_flow(double time, const FlowRecord& flow);
  /// \param openings  in the order of ResultTables::openings
  void write_openings(double time, const std::vector<OpeningRecord>& openings);
  void write_iterations(const StepRecord& record);
  void write_coupling(const StepRecord& record, const CouplingReport& coupling);
  void write_energy(const StepRecord& record, const EnergyRecord& energy);
  void write_surfaces(double time, const std::vector<SurfaceRecord>& surfaces);

  /// Takes in what the tables hold now as what a restart goes on from.
  void take_digests();
  TableDigests digests() const;
  /// Puts all tables onto the disk and closes them; nothing may be written after that. \throws WriteError
  void close();

 private:
  void open_tables(const ResultTables& tables, bool append);

  using Rows = std::vector<std::vector<double>>;
  void write(std::optional<CsvFile>& table, const std::string& name, const Rows& rows,
             const std::vector<std::string>& names = {});

  FirstProcess* first_;
  std::filesystem::path folder_;
  std::optional<EnergyParts> energy_parts_;
  std::map<std::string, TableDigest> digests_;
  std::vector<std::string> opening_names_;
  std::optional<CsvFile> centerline_, wall_, flow_, openings_, iterations_, coupling_, energy_, surfaces_;
  std::map<std::string, CsvFile> sampled_;
};

}  // namespace fsi
