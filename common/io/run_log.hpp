#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "io/first_process.hpp"

namespace spdlog {
class logger;
}

namespace fsi {

class CheckedFile;

/// DIR/run.log: time-stamped lines, in the system's hands as soon as they are written. Receives the convergence history.
/// All functions throw WriteError when the file cannot be written, or has been deleted. Of several processes the first one
/// writes; the others have a log that keeps silent.
class RunLog {
 public:
  /// \param append  continue an existing log (restart) instead of starting it afresh
  /// \param first   tells the processes, which make and close the log together, of lines that could not be written; must
  ///                outlive this
  explicit RunLog(const std::filesystem::path& folder, bool append = false,
                  FirstProcess& first = FirstProcess::alone());
  ~RunLog();
  RunLog(RunLog&&) noexcept;
  RunLog& operator=(RunLog&&) noexcept;

  void info(const std::string& line);
  void warning(const std::string& line);
  void error(const std::string& line);

  /// Onto the disk, and closes; no line may follow.
  void close();

 private:
  FirstProcess* first_;
  std::shared_ptr<CheckedFile> file_;
  std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace fsi
