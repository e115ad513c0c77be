#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fsi {

/// An option of a program that does something else with a case than a run.
struct ExtraOption {
  std::string name;             ///< "--systems"
  std::string type;             ///< what the value is called in the help; not used for a flag
  std::string description;      ///< one sentence
  std::string* text = nullptr;  ///< receives the value; null: the option is a flag
  bool* flag = nullptr;         ///< set where the flag is given; must not be null where `text` is
};

/// What a driver is asked to do: `CASE.toml -o DIR [--restart DIR] [--set key=value]... [--threads N] [--force] [-q]`, or
/// `CASE.toml --check [--set key=value]... [--threads N]`.
struct CommandLine {
  std::filesystem::path case_file;
  std::filesystem::path output;        ///< result folder; the restarted one when --restart is given without -o
  std::filesystem::path restart;       ///< result folder to continue; empty: start at rest
  std::vector<std::string> overrides;  ///< `key=value` of each --set, in order
  int threads = 0;                     ///< 0: chosen by the program
  bool check = false;                  ///< nothing is run or written: says what a run would be
  bool force = false;                  ///< results in `output` may be replaced
  bool quiet = false;
  std::string program;  ///< as it was called
  int processes = 1;    ///< that were started together
};

/// The command that continues the run of this command line in its result folder, ready to be pasted into a shell.
std::string restart_command(const CommandLine& line);

/// Parses a driver's arguments. Empty when --help, --help-keys or --version was asked for and has been printed.
/// \param program      name of the program, for help and version
/// \param description  one sentence for the help
/// \throws InputError naming the option and the offending value
std::optional<CommandLine> parse_command_line(const std::string& program, const std::string& description, int argc,
                                              const char* const* argv);

/// The same for a program that takes a case and makes no run of it: in place of --restart, --check and --force it has
/// options of its own.
std::optional<CommandLine> parse_command_line(const std::string& program, const std::string& description, int argc,
                                              const char* const* argv, const std::vector<ExtraOption>& own);

}  // namespace fsi
