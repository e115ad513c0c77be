#include "io/run_log.hpp"

#include <spdlog/details/null_mutex.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/base_sink.h>

#include <utility>

#include "base/printable.hpp"
#include "io/checked_file.hpp"

namespace fsi {

namespace {

/// The logger's sink. The library's own file sink loses the errors of flush and close.
class CheckedSink final : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
 public:
  explicit CheckedSink(std::shared_ptr<CheckedFile> file) : file_(std::move(file)) {}

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    file_->require_in_place();
    file_->write({line.data(), line.size()});
  }
  void flush_() override {}  // nothing is kept back

 private:
  std::shared_ptr<CheckedFile> file_;
};

}  // namespace

RunLog::RunLog(const std::filesystem::path& folder, bool append, FirstProcess& first) : first_(&first) {
  const auto file = folder / "run.log";
  first.now(
      [&] { file_ = std::make_shared<CheckedFile>(append ? CheckedFile::append(file) : CheckedFile::create(file)); });
  if (!file_) return;
  logger_ = std::make_shared<spdlog::logger>("run", std::make_shared<CheckedSink>(file_));
  logger_->set_pattern("%Y-%m-%d %H:%M:%S.%e %-7l %v");
  // The logger catches what a sink throws and calls this in its handler: rethrown, the error reaches the caller.
  logger_->set_error_handler([](const std::string&) { throw; });
}

RunLog::~RunLog() = default;
RunLog::RunLog(RunLog&&) noexcept = default;
RunLog& RunLog::operator=(RunLog&&) noexcept = default;

// One line per entry. By "{}" a brace in the text is no format directive.
void RunLog::info(const std::string& line) {
  first_->later([&] { logger_->info("{}", printable(line)); });
}
void RunLog::warning(const std::string& line) {
  first_->later([&] { logger_->warn("{}", printable(line)); });
}
void RunLog::error(const std::string& line) {
  first_->later([&] { logger_->error("{}", printable(line)); });
}

void RunLog::close() {
  first_->agree();
  first_->now([&] {
    file_->require_in_place();
    file_->synchronise();
    file_->close();
  });
}

}  // namespace fsi
