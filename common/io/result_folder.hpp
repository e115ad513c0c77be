#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/csv_file.hpp"
#include "io/earlier_tables.hpp"
#include "io/first_process.hpp"
#include "io/result_tables.hpp"

namespace fsi {

/// Refuses a new run in a folder that holds results of finished steps, whether or not that run is finished or its
/// summary can be read. A folder whose run has not finished a step may be used again.
/// \param tables  files of all tables that some run may have
/// \param go_on   the command that continues a run in this folder
/// \throws InputError that says what the folder holds and how to continue
void require_no_results(const std::filesystem::path& folder, const std::vector<std::string>& tables,
                        const std::string& go_on);

/// Refuses a new run in a folder that holds anything but the regular files of a run and run.lock, since the run
/// replaces its contents. \throws InputError
void require_results_only(const std::filesystem::path& folder, const std::vector<std::string>& tables);

/// Refuses a folder in which something else has the name of a result file: a folder, a pipe or a device.
/// \param follow  whether symbolic links are followed: for reading, not for writing
/// \throws InputError
void require_regular_results(const std::filesystem::path& folder, const std::vector<std::string>& tables, bool follow);

/// The folder of one run and its CSV tables. Rows are in the system's hands when write() returns, on disk after
/// close(). Of several processes the first writes; the others have an object of this class, too, and pass it the same
/// rows.
class ResultFolder {
 public:
  /// A new run. Creates the folder; one that holds nothing but result files is emptied.
  /// \throws InputError when the folder holds anything else, or cannot be created or written
  /// \param tables  of the run
  /// \param known   files of all tables that some run may have
  /// \param first   tells the other processes of rows that could not be written; all make and close the folder
  ///                together; must outlive this
  ResultFolder(std::filesystem::path folder, const std::vector<ResultTable>& tables,
               const std::vector<std::string>& known, FirstProcess& first = FirstProcess::alone());

  /// Continues a run whose tables have been checked: copies their rows up to its checkpoint; in the same folder that
  /// cuts them there.
  /// \throws InputError as above
  ResultFolder(std::filesystem::path folder, const std::vector<ResultTable>& tables,
               const std::vector<std::string>& known, const EarlierTables& earlier,
               FirstProcess& first = FirstProcess::alone());

  const std::filesystem::path& path() const { return folder_; }

  /// Adds rows of a level or step to one of the tables. \throws ConvergenceError before anything is written when a
  /// number is not finite; WriteError, of several processes at the next FirstProcess::agree()
  void write(const TableRows& rows);

  /// Updates the digests to what the tables hold now: for a checkpoint, from which a restart continues.
  void take_digests();
  TableDigests digests() const;
  /// Puts all tables on disk and closes them; nothing may be written after that. \throws WriteError
  void close();

 private:
  /// A table; file and digest are at the first process only.
  struct Open {
    ResultTable table;
    std::optional<CsvFile> file;
    std::optional<TableDigest> digest;
  };
  void open_tables(const std::vector<ResultTable>& tables, bool append);

  FirstProcess* first_;
  std::filesystem::path folder_;
  std::vector<Open> tables_;
};

}  // namespace fsi
