#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/run_log.hpp"
#include "observers/observer.hpp"
#include "run/console.hpp"

namespace fsi {

/// Messages of a run to its log and console, once it has them; before that warnings wait, and what is said is dropped.
class RunMessages : public Messages {
 public:
  void to(RunLog& log, Console& console) {
    log_ = &log;
    console_ = &console;
    for (const std::string& said : early_) warn(said);
    early_.clear();
  }
  void warn(const std::string& said) override {
    if (console_ == nullptr) return early_.push_back(said);
    console_->line(said);
    log_only(said);
  }
  void say(const std::string& said) override {
    if (console_ != nullptr) console_->line(said);
    if (log_ != nullptr) log_->info(said);
  }
  void note(const std::string& key, const nlohmann::json& value) override { summary[key] = value; }
  /// A warning for the log alone, as of a step in progress.
  void log_only(const std::string& said) {
    if (log_ != nullptr) log_->warning(said);
  }

  nlohmann::json summary;  ///< of the run: summary.json

 private:
  RunLog* log_ = nullptr;
  Console* console_ = nullptr;
  std::vector<std::string> early_;
};

}  // namespace fsi
