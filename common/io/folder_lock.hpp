// Keeps two runs from working in one result folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/removed_on_signal.hpp"

namespace fsi {

/// Name of the lock file in a result folder.
constexpr const char* lock_name = "run.lock";

/// While it lives, no other run can use the folder. The process holds the kernel's lock (flock) on the file run.lock,
/// which vanishes with the process, however it ends. The file's one line names the process for messages:
/// "fsi-monolithic, process 4711 on host gauss". On a file system without such locks the file itself is the lock, and
/// stays behind when the process is killed.
///
/// fsi-compare locks the folders of its studies in the same way (compare/fsi_compare/base/folder_lock.py).
class FolderLock {
 public:
  /// Makes the folder where needed and takes its lock. Takes over a lock that a process of this host has left behind,
  /// see said().
  /// \throws InputError when a run works in the folder, when a lock of another host was left there (locks of some
  ///         network file systems are known to one host only), or when the folder cannot be made or written
  FolderLock(const std::filesystem::path& folder, const std::string& program);
  /// Removes the lock, and those of the folders made for it that are empty.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// A message on the lock that was taken over; empty: none.
  const std::string& said() const { return said_; }

  /// \throws InputError when the lock has been removed, perhaps with the folder: another run may work there
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

/// Refuses a folder that a run is writing to. Changes nothing in it.
/// \param remedy  what the user can do
/// \throws InputError that names the process and its host
void require_no_run_in(const std::filesystem::path& folder, const std::string& remedy);

/// Makes a folder and the missing ones above it. \returns those that it made, the deepest first
/// \throws InputError when there is a file of that name, or the folder cannot be made
std::vector<std::filesystem::path> make_folder(const std::filesystem::path& folder);

}  // namespace fsi
