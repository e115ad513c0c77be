#include "run/result_place.hpp"

#include <filesystem>
#include <system_error>

#include "io/checkpoint.hpp"
#include "io/folder_lock.hpp"
#include "io/result_folder.hpp"
#include "observers/observers.hpp"

namespace fsi {

bool in_place(const CommandLine& line) {
  std::error_code error;
  return !line.restart.empty() &&
         (line.output == line.restart || std::filesystem::equivalent(line.output, line.restart, error));
}

void require_no_run_in_source(const CommandLine& line) {
  if (!line.restart.empty() && !in_place(line))
    require_no_run_in(line.restart, "wait for its end, or stop it (Ctrl-C), before it is continued");
}

void require_folder(const CommandLine& line) {
  const auto tables = table_files();
  if (!line.restart.empty()) require_regular_results(line.restart, tables, true);
  require_regular_results(line.output, tables, false);
  if (in_place(line)) return;
  if (!line.force) require_no_results(line.output, tables, restart_command(line));
  require_results_only(line.output, tables);
}

std::string way_on(const CommandLine& line) {
  std::error_code error;
  if (std::filesystem::exists(checkpoint_file(line.output), error)) return "continue by: " + restart_command(line);
  return line.force ? "run it again" : "run it again with --force";
}

}  // namespace fsi
