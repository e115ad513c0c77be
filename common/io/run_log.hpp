#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace spdlog {
class logger;
}

namespace fsi {

/// DIR/run.log: time-stamped lines, on disk as soon as they are written. Receives the convergence history.
class RunLog {
 public:
  /// \param append  continue an existing log (restart) instead of starting it afresh
  /// \throws InputError when the file cannot be written
  explicit RunLog(const std::filesystem::path& folder, bool append = false);
  ~RunLog();
  RunLog(RunLog&&) noexcept;
  RunLog& operator=(RunLog&&) noexcept;

  void info(const std::string& line);
  void warning(const std::string& line);
  void error(const std::string& line);

 private:
  std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace fsi
