// Keeps two runs from working in one result folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/removed_on_signal.hpp"

namespace fsi {

/// Name of the lock file in a result folder.
constexpr const char* lock_name = "run.lock";

/// One run, one folder: while it lives, no other run can have the folder. The process holds the kernel's lock (flock) on
/// the file run.lock, which vanishes with the process, however it ends. The file's one line names the process, as it is
/// said to others: "fsi-monolithic, process 4711 on host gauss". Where a file system has no such locks, the file itself is
/// the lock, and stays behind when the process is killed.
///
/// fsi-compare locks the folders of its studies alike (compare/fsi_compare/starting/folder_lock.py).
class FolderLock {
 public:
  /// Makes the folder where needed and takes its lock. A lock that a process of this host has left behind is taken
  /// over, see `said`.
  /// \throws InputError when a run works in the folder, when a lock of another host was left there (locks of some network
  ///         file systems are known to one host only), or when the folder cannot be made or written
  FolderLock(const std::filesystem::path& folder, const std::string& program);
  /// Removes the lock, and the folders that were made for it and are empty.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// What was done about a lock that had been left behind; empty: there was none.
  const std::string& said() const { return said_; }

  /// \throws InputError when somebody has removed the lock, and with it perhaps the folder: another run may be there
  void require_held() const;

 private:
  bool take(const std::string& program, int tries);
  bool open_file();
  void close_file();
  void write_holder(const std::string& program);
  bool is_ours() const;
  void release();

  std::filesystem::path folder_, file_;
  std::vector<std::filesystem::path> made_;  ///< folders, the deepest first
  std::vector<RemovedOnSignal> on_signal_;
  int descriptor_ = -1;
  std::string said_;
};

/// Refuses to read or to replace what a run is writing. Changes nothing in the folder.
/// \param remedy  what the user can do
/// \throws InputError that names the process and its host
void require_no_run_in(const std::filesystem::path& folder, const std::string& remedy);

/// Makes a folder with those above it that are missing; \returns the ones made, the deepest first
/// \throws InputError when there is a file of that name, or the folder cannot be made
std::vector<std::filesystem::path> make_folder(const std::filesystem::path& folder);

}  // namespace fsi
