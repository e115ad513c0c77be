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
  /// At most 16 live at a time; what does not fit stays behind after a signal, which does no harm.
  explicit RemovedOnSignal(const std::filesystem::path& path, FilesInside inside = FilesInside::stay) noexcept;
  ~RemovedOnSignal();
  RemovedOnSignal(RemovedOnSignal&& other) noexcept;
  RemovedOnSignal& operator=(RemovedOnSignal&&) = delete;
  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal& operator=(const RemovedOnSignal&) = delete;

 private:
  int place_ = -1;
};

/// Holds back a signal that is to end the program at once while an object lives: until a new file is registered for
/// removal, or one that no longer is has been removed.
class SignalsWait {
 public:
  SignalsWait() noexcept;
  /// The last one raises the signal that was held back.
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;
};

/// Whether a signal has to wait; it is raised again when it may take effect. For signal handlers.
bool has_to_wait(int signal) noexcept;

/// Removes all that is registered, the last place first, so that a file goes before its folder.
/// May be called by a signal handler.
void remove_what_a_signal_leaves() noexcept;

}  // namespace fsi
