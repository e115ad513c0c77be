#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/result_tables.hpp"
#include "io/table_digest.hpp"

namespace fsi {

/// What the tables of a run must hold by its checkpoint.
struct EarlierSteps {
  std::int64_t step = 0;    ///< the last finished one
  double time = 0;          ///< its end, ms; in statics the fraction of the load
  std::int64_t levels = 0;  ///< tables with rows per level hold those of the steps 1 to this
  TableDigests digests{};   ///< of the rows taken over; a table without one is checked against the others alone
};

/// The tables of an earlier run, checked row by row: a restart takes over what the run wrote up to its checkpoint,
/// nothing missing, doubled or out of order, and every number finite. Rows of steps after the checkpoint and a torn
/// last line are left out. Memory needed: a time per step.
class EarlierTables {
 public:
  /// Reads the tables `wanted` in `folder`, iterations.csv the first of them. \throws InputError naming file and line
  EarlierTables(const std::filesystem::path& folder, const std::vector<ResultTable>& wanted, const EarlierSteps& steps);

  const std::filesystem::path& folder() const { return folder_; }
  /// Ends of the steps 1 to the last one, as EarlierSteps::time.
  const std::vector<double>& times() const { return times_; }
  /// Values of the rows of the last level in a table of levels, row after row, NaN for an empty cell; empty if there is
  /// no such table or level.
  const std::vector<double>& last_level(const std::string& file) const;

  /// Copies the checked rows into a folder, which may be the same: each table by a temporary file and rename, so that
  /// after a kill each has the rows that a restart needs. \throws InputError when one cannot be read, WriteError
  void copy_to(const std::filesystem::path& folder) const;

 private:
  /// A table and how much of it is taken over.
  struct Part {
    std::string file;
    std::uint64_t bytes = 0;
    std::vector<double> last_level{};
  };
  Part checked(const ResultTable& table, const EarlierSteps& steps);
  Part checked_steps(const ResultTable& table, const EarlierSteps& steps);
  Part checked_levels(const ResultTable& table, const EarlierSteps& steps) const;
  Part checked_within_steps(const ResultTable& table, const EarlierSteps& steps) const;
  Part with_digest(Part part, const EarlierSteps& steps) const;

  std::filesystem::path folder_;
  std::vector<double> times_;
  std::vector<Part> parts_;
};

}  // namespace fsi
