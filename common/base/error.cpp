#include "base/error.hpp"

namespace fsi {

namespace {

std::string joined(const std::string& file, const std::string& key, const std::string& problem,
                   const std::string& remedy) {
  std::string text;
  if (!file.empty()) text += file + ": ";
  if (!key.empty()) text += key + ": ";
  text += problem;
  if (!remedy.empty()) text += "; " + remedy;
  return text;
}

}  // namespace

InputError::InputError(const std::string& file, const std::string& key, const std::string& problem,
                       const std::string& remedy)
    : std::runtime_error(joined(file, key, problem, remedy)) {}

ConvergenceError::ConvergenceError(const std::string& problem, const std::string& remedy)
    : std::runtime_error(remedy.empty() ? problem : problem + "; try " + remedy) {}

}  // namespace fsi
