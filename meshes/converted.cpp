#include "meshes/converted.hpp"

#include <sstream>

#include "base/error.hpp"
#include "host/child_program.hpp"
#include "meshes/mesh_report.hpp"
#include "run/program.hpp"

namespace fsi {

void refuse_file(const std::string& file, const std::string& said_of, std::string said) {
  if (said.rfind(said_of + ": ", 0) == 0) said.erase(0, said_of.size() + 2);
  throw InputError(file, "", said, "");
}

namespace {

/// Repeats the warnings of fsi-compare as this program's.
void repeat_warnings(const std::string& errors) {
  const std::string mark = "fsi-compare: warning: ";
  std::istringstream lines(errors);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind(mark, 0) == 0) warn(mesh_program, line.substr(mark.size()));
}

/// The error of fsi-compare, warnings before it left out; without one the last line, as of a traceback.
std::string error_of(const std::string& errors) {
  const std::string mark = "fsi-compare: error: ";
  std::string last = "fsi-compare ended without a message";
  std::istringstream lines(errors);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(mark, 0) == 0) return line.substr(mark.size());
    if (!line.empty()) last = line;
  }
  return last;
}

}  // namespace

std::string converted(const std::string& file, const std::vector<std::string>& words, bool quiet) {
  const auto program = beside_this_program("fsi-compare");
  if (program.empty())
    throw InputError("fsi-compare", "", "is not beside fsi-mesh, which needs it to read other formats",
                     "install both from the same sources");
  std::vector<std::string> command{program.string()};
  command.insert(command.end(), words.begin(), words.end());
  const ChildEnd end = run_child(command);
  if (end.code == 0) {
    if (!quiet) repeat_warnings(end.errors);
    return end.output;
  }
  refuse_file(file, file, error_of(end.errors));
}

}  // namespace fsi
