#include "run/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>
#include <functional>

#include "base/error.hpp"
#include "base/names.hpp"
#include "base/printable.hpp"
#include "base/version.hpp"
#include "case/case_reader.hpp"
#include "host/standard_streams.hpp"

namespace fsi {

namespace {

/// Every long option of the parser, for "did you mean".
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* option : app.get_options())
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

int thread_count(const std::string& text) {
  int count = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  constexpr int most = 1024;
  if (error != std::errc() || end != text.data() + text.size() || count < 0 || count > most)
    throw InputError("", "--threads", "\"" + text + "\" is no number of threads",
                     "give at most " + std::to_string(most) + ", or 0 for as many as are of use");
  return count;
}

/// CLI11's complaint as one of ours.
[[noreturn]] void refuse(const CLI::App& app, const CLI::ParseError& error) {
  throw InputError("", "", error.what(), "see " + app.get_name() + " --help");
}

void refuse_extras(const CLI::App& app) {
  for (const auto& word : app.remaining()) {
    if (word.size() > 1 && word[0] == '-')
      throw InputError("", word, "unknown option",
                       word[1] == '-' ? "did you mean " + nearest_name(word, option_names(app)) + "?"
                                      : "see " + app.get_name() + " --help");
    throw InputError("", word, "one argument too many", "give a single case file");
  }
}

/// A word with characters that cannot be shown, byte by byte where need be, as bash, zsh and ksh read it back.
std::string quoted_with_escapes(const std::string& word) {
  std::string text = "$'";
  for (const char c : word) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\'' || c == '\\')
      text += std::string("\\") + c;
    else if (byte < 0x20 || byte >= 0x7f)
      text += fmt::format("\\{:03o}", byte);
    else
      text += c;
  }
  return text + "'";
}

/// A word as a shell reads it back.
std::string quoted(const std::string& word) {
  if (printable(word) != word) return quoted_with_escapes(word);
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || std::strchr("_-+./,:=@%", c) != nullptr; };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string text = "'";
  for (const char c : word) {
    if (c == '\'')
      text += "'\\''";
    else
      text += c;
  }
  return text + "'";
}

/// Options of one kind of program, whose values go to `line`.
using AddOptions = std::function<void(CLI::App& app, CommandLine& line)>;

/// What every program with a case has, with `add_own` behind -o.
std::optional<CommandLine> parse(const std::string& program, const std::string& description, int argc,
                                 const char* const* argv, const AddOptions& add_own) {
  CommandLine line;
  std::string threads;
  bool help = false, help_keys = false, show_version = false;

  CLI::App app(description, program);
  app.set_help_flag();  // help is an ordinary flag here, so that nothing is thrown for it
  app.allow_extras();
  app.add_option("case", line.case_file, "Case file (TOML)")->type_name("CASE.toml");
  auto* output = app.add_option("-o,--output", line.output, "Result folder, made where needed")->type_name("DIR");
  add_own(app, line);
  app.add_option("--set", line.overrides, "Override an entry of the case file; may be repeated")
      ->type_name("key=value")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  app.add_option("--threads", threads, "Threads; 0: one per idle core, one on a small mesh (default)")->type_name("N");
  app.add_flag("-q,--quiet", line.quiet, "No progress, errors only");
  app.add_flag("-h,--help", help, "Print this help");
  app.add_flag("--help-keys", help_keys, "List the keys of a case file");
  app.add_flag("--version", show_version, "Print the version");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    refuse(app, error);
  }
  if (help) {
    print(app.help());
    return {};
  }
  if (help_keys) {
    print(case_keys_help());
    return {};
  }
  if (show_version) {
    print(version_text(program) + "\n");
    return {};
  }
  refuse_extras(app);
  if (line.case_file.empty())
    throw InputError("", "", "no case file given", program + " CASE.toml -o DIR, or see " + program + " --help");
  if (output->count() > 0 && line.output.empty())
    throw InputError("", "--output", "the folder's name is empty", "give -o DIR");
  if (const auto* restart = app.get_option_no_throw("--restart");
      restart != nullptr && restart->count() > 0 && line.restart.empty())
    throw InputError("", "--restart", "the folder's name is empty", "give --restart DIR");
  if (line.check && !line.restart.empty())
    throw InputError("", "--check", "looks at a case from its beginning, not at a run to go on with",
                     "leave --restart out");
  if (line.output.empty() && line.restart.empty() && !line.check)
    throw InputError("", "--output", "no result folder given", "add -o DIR");
  if (line.output.empty()) line.output = line.restart;
  line.program = argc > 0 ? argv[0] : program;
  if (!threads.empty()) line.threads = thread_count(threads);
  return line;
}

}  // namespace

std::string restart_command(const CommandLine& line) {
  std::vector<std::string> words;
  if (line.processes > 1) words = {"mpirun", "-n", std::to_string(line.processes)};  // any number will do
  words.insert(words.end(),
               {line.program, line.case_file.string(), "--restart", line.output.string(), "-o", line.output.string()});
  for (const auto& entry : line.overrides) words.insert(words.end(), {"--set", entry});
  if (line.threads > 0) words.insert(words.end(), {"--threads", std::to_string(line.threads)});
  if (line.quiet) words.emplace_back("-q");
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + quoted(word);
  return text;
}

std::optional<CommandLine> parse_command_line(const std::string& program, const std::string& description, int argc,
                                              const char* const* argv) {
  return parse(program, description, argc, argv, [](CLI::App& app, CommandLine& line) {
    app.add_option("--restart", line.restart, "Continue the run in this result folder; without -o in place")
        ->type_name("DIR");
    app.add_flag("--check", line.check,
                 "Say what a run would be: media, openings, unknowns, memory, time; writes nothing");
    app.add_flag("--force", line.force, "Replace the results of an earlier run in the result folder");
  });
}

std::optional<CommandLine> parse_command_line(const std::string& program, const std::string& description, int argc,
                                              const char* const* argv, const std::vector<ExtraOption>& own) {
  return parse(program, description, argc, argv, [&](CLI::App& app, CommandLine&) {
    for (const auto& option : own) {
      if (option.text)
        app.add_option(option.name, *option.text, option.description)->type_name(option.type);
      else
        app.add_flag(option.name, *option.flag, option.description);
    }
  });
}

}  // namespace fsi
