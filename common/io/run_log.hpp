#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace spdlog {
class logger;
}

namespace fsi {

class CheckedFile;

/// DIR/run.log: time-stamped lines, in the system's hands as soon as they are written. Receives the convergence history.
/// All functions throw WriteError when the file cannot be written, or has been deleted.
class RunLog {
 public:
  /// \param append  continue an existing log (restart) instead of starting it afresh
  explicit RunLog(const std::filesystem::path& folder, bool append = false);
  ~RunLog();
  RunLog(RunLog&&) noexcept;
  RunLog& operator=(RunLog&&) noexcept;

  void info(const std::string& line);
  void warning(const std::string& line);
  void error(const std::string& line);

  /// Onto the disk, and closes; no line may follow.
  void close();

 private:
  std::shared_ptr<CheckedFile> file_;
  std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace fsi
