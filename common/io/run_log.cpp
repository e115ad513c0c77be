#include "io/run_log.hpp"

#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>

#include "base/error.hpp"
#include "base/printable.hpp"

namespace fsi {

RunLog::RunLog(const std::filesystem::path& folder, bool append) {
  const auto file = folder / "run.log";
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_st>(file.string(), !append);
    logger_ = std::make_shared<spdlog::logger>("run", std::move(sink));
  } catch (const spdlog::spdlog_ex& error) {
    throw InputError(file.string(), "", std::string("cannot be written (") + error.what() + ")",
                     "check the permissions and the free space of the folder");
  }
  logger_->set_pattern("%Y-%m-%d %H:%M:%S.%e %-7l %v");
  logger_->flush_on(spdlog::level::trace);
}

RunLog::~RunLog() = default;
RunLog::RunLog(RunLog&&) noexcept = default;
RunLog& RunLog::operator=(RunLog&&) noexcept = default;

// One entry, one line. Text goes through "{}": a brace in it is no format directive.
void RunLog::info(const std::string& line) {
  logger_->info("{}", printable(line));
}
void RunLog::warning(const std::string& line) {
  logger_->warn("{}", printable(line));
}
void RunLog::error(const std::string& line) {
  logger_->error("{}", printable(line));
}

}  // namespace fsi
