#include "meshes/converted.hpp"

#include "base/child_program.hpp"
#include "base/error.hpp"

namespace fsi {

void refuse_file(const std::string& file, const std::string& said_of, std::string said) {
  if (said.rfind(said_of + ": ", 0) == 0) said.erase(0, said_of.size() + 2);
  throw InputError(file, "", said, "");
}

std::string converted(const std::string& file, const std::vector<std::string>& words) {
  const auto program = beside_this_program("fsi-compare");
  if (program.empty())
    throw InputError("fsi-compare", "", "is not beside fsi-mesh, which needs it to read other formats",
                     "install both from the same sources");
  std::vector<std::string> command{program.string()};
  command.insert(command.end(), words.begin(), words.end());
  const ChildEnd end = run_child(command);
  if (end.code == 0) return end.output;
  std::string said = end.errors.substr(0, end.errors.find('\n'));
  if (const std::string mark = "fsi-compare: error: "; said.rfind(mark, 0) == 0) said.erase(0, mark.size());
  refuse_file(file, file, said.empty() ? "fsi-compare ended without a message" : said);
}

}  // namespace fsi
