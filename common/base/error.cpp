#include "base/error.hpp"

#include "base/printable.hpp"

namespace fsi {

namespace {

// Characters of a message that each part may take. The first three may hold what the user handed over; a remedy is the
// program's own words, perhaps with a command to paste.
constexpr std::size_t file_limit = 200, key_limit = 200, problem_limit = 600, remedy_limit = 2000;
constexpr std::size_t failure_limit = 10000;  // a solver's message, which ends with the command to continue

std::string joined(const std::string& file, const std::string& key, const std::string& problem,
                   const std::string& remedy) {
  std::string text;
  if (!file.empty()) text += shortened_path(file, file_limit) + ": ";
  if (!key.empty()) text += shortened(key, key_limit) + ": ";
  text += shortened(problem, problem_limit);
  if (!remedy.empty()) text += "; " + shortened(remedy, remedy_limit);
  return text;
}

}  // namespace

InputError::InputError(const std::string& file, const std::string& key, const std::string& problem,
                       const std::string& remedy)
    : std::runtime_error(joined(file, key, problem, remedy)) {}

ConvergenceError::ConvergenceError(const std::string& problem, const std::string& remedy)
    : std::runtime_error(shortened(remedy.empty() ? problem : problem + "; try " + remedy, failure_limit)) {}

}  // namespace fsi
