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

/// Refuses a new run in a folder that holds results of finished steps: whether that run is finished or not, whether its
/// summary can be read or not, they are worth the time they took. A folder whose run has not come to the end of a step
/// may be used again.
/// \param tables  files of all tables that some run may have
/// \param go_on   the command that continues a run in this folder
/// \throws InputError that says what the folder holds and how to go on
void require_no_results(const std::filesystem::path& folder, const std::vector<std::string>& tables,
                        const std::string& go_on);

/// Refuses a new run in a folder that holds anything but the regular files of a run: those make way, others are not
/// ours to delete. \throws InputError
void require_results_only(const std::filesystem::path& folder, const std::vector<std::string>& tables);

/// Refuses a folder in which the name of a result file is that of something else, such as a folder, a pipe or a device.
/// \param follow  whether a symbolic link counts as what it leads to: for reading, not for writing
/// \throws InputError
void require_regular_results(const std::filesystem::path& folder, const std::vector<std::string>& tables, bool follow);

/// The folder of one run and its CSV tables, each row on disk when its step is done. Of several processes the first one
/// writes: the others have a folder of this class, too, to which they hand over the same rows.
class ResultFolder {
 public:
  /// A new run. Creates the folder; one that holds nothing but result files is emptied.
  /// \throws InputError when the folder holds anything else, or cannot be created or written
  /// \param tables  of the run
  /// \param known   files of all tables that some run may have
  /// \param first   tells the processes, which make and close the folder together, of rows that could not be written;
  ///                must outlive this
  ResultFolder(std::filesystem::path folder, const std::vector<ResultTable>& tables,
               const std::vector<std::string>& known, FirstProcess& first = FirstProcess::alone());

  /// Continues a run whose tables have been checked: they are copied, or in place cut behind its checkpoint.
  /// \throws InputError as above
  ResultFolder(std::filesystem::path folder, const std::vector<ResultTable>& tables,
               const std::vector<std::string>& known, const EarlierTables& earlier,
               FirstProcess& first = FirstProcess::alone());

  const std::filesystem::path& path() const { return folder_; }

  /// Adds rows of a level or step to one of the tables. \throws ConvergenceError before anything is written when a number
  /// is not finite; WriteError
  void write(const TableRows& rows);

  /// Takes in what the tables hold now as what a restart goes on from.
  void take_digests();
  TableDigests digests() const;
  /// Puts all tables onto the disk and closes them; nothing may be written after that. \throws WriteError
  void close();

 private:
  /// A table with its file, which the first process alone has.
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
