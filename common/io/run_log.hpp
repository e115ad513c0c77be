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

/// DIR/run.log: time-stamped lines, in the system's hands when a function returns. Receives the convergence history.
/// All functions throw WriteError when the file cannot be written or has been deleted. Of several processes the first
/// writes, and failed lines are reported at the next FirstProcess::agree(); the logs of the others do nothing.
class RunLog {
 public:
  /// \param append  continue an existing log (restart) in place of emptying it
  /// \param first   tells the other processes of lines that could not be written; all make and close the log together;
  ///                must outlive this
  explicit RunLog(const std::filesystem::path& folder, bool append = false,
                  FirstProcess& first = FirstProcess::alone());
  ~RunLog();
  RunLog(RunLog&&) noexcept;
  RunLog& operator=(RunLog&&) noexcept;

  void info(const std::string& line);
  void warning(const std::string& line);
  void error(const std::string& line);

  /// Puts the log on disk and closes it; no line may follow.
  void close();

 private:
  FirstProcess* first_;
  std::shared_ptr<CheckedFile> file_;
  std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace fsi
