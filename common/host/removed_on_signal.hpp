#pragma once

#include <filesystem>

namespace fsi {

/// What happens to the files of a folder that is to be removed.
enum class FilesInside {
  stay,  ///< and the folder with them
  go     ///< for a folder that is the program's own; folders in it stay
};

/// A file, or a folder, that is removed when a signal ends the program at once (run/interruption.hpp) while this object
/// lives. The owner removes it in every other case.
class RemovedOnSignal {
 public:
  /// Only a few can be kept; what does not fit stays behind after a signal, which does no harm.
  explicit RemovedOnSignal(const std::filesystem::path& path, FilesInside inside = FilesInside::stay) noexcept;
  ~RemovedOnSignal();
  RemovedOnSignal(RemovedOnSignal&& other) noexcept;
  RemovedOnSignal& operator=(RemovedOnSignal&&) = delete;
  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal& operator=(const RemovedOnSignal&) = delete;

 private:
  int place_ = -1;
};

/// While one lives, a signal that is to end the program at once waits: until what is being made is kept for removal, or
/// what is no longer kept has been removed.
class SignalsWait {
 public:
  SignalsWait() noexcept;
  /// The last one lets the signal that has come take effect.
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;
};

/// Asked by a signal handler: whether the signal has to wait. It is raised again when it may take effect.
bool has_to_wait(int signal) noexcept;

/// Removes them all, the youngest first. May be called by a signal handler.
void remove_what_a_signal_leaves() noexcept;

}  // namespace fsi
