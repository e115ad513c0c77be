#include "restart/recalled_archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "io/first_process.hpp"

namespace fsi {

namespace {

constexpr const char* another_version = "the checkpoint comes from another version; run from the start";

[[noreturn]] void refuse_missing(const std::filesystem::path& file, const std::string& name) {
  throw InputError(file.string(), name, "missing", another_version);
}

}  // namespace

void refuse_entry(const std::filesystem::path& file, const std::string& name, const std::string& problem) {
  throw InputError(file.string(), name, problem,
                   "the checkpoint is damaged; restart from another folder, or run from the start");
}

void require_in(const Range& range, double number, const std::filesystem::path& file, const std::string& name) {
  if (!std::isfinite(number)) refuse_entry(file, name, "holds a number that is not finite");
  if (number >= range.least && number <= range.most && (!range.whole || number == std::floor(number))) return;
  refuse_entry(file, name,
               fmt::format("holds {:g}, no {}number from {:g} to {:g}", number, range.whole ? "whole " : "",
                           range.least, range.most));
}

RecalledArchive::RecalledArchive(std::filesystem::path file, const Checkpoint& head, StoredArrays arrays,
                                 const Communicator& processes)
    : file_(std::move(file)), head_(head), arrays_(std::move(arrays)), processes_(processes) {}

bool RecalledArchive::has(const std::string& name) const {
  return head_.reals.count(name) + head_.integers.count(name) > 0 ||
         std::find(arrays_.names.begin(), arrays_.names.end(), name) != arrays_.names.end();
}

void RecalledArchive::array(const std::string& name, ArrayKind kind, std::vector<double>& values,
                            const ArrayRule& rule) {
  if (!has(name)) refuse_missing(file_, name);
  asked_.insert(name);
  std::vector<double> found = arrays_.read(name, kind);
  auto length = rule.length ? rule.length : arrays_.length(kind);
  if (rule.columns) length = *rule.columns * length.value();
  do_together(processes_, [&] {
    if (length && found.size() != *length)
      throw InputError(file_.string(), name, fmt::format("has {} values, not {}", found.size(), *length),
                       "restart with the case and mesh of that run");
    if (found.size() > rule.most)
      throw InputError(file_.string(), name, fmt::format("has {} values, more than {}", found.size(), rule.most),
                       another_version);
    for (const double number : found) require_in(rule.each, number, file_, name);
  });
  values = std::move(found);
}

void RecalledArchive::number(const std::string& name, double& value, const Range& range) {
  const auto found = head_.reals.find(name);
  if (found == head_.reals.end()) refuse_missing(file_, name);
  require_in(range, found->second, file_, name);
  value = found->second;
}

void RecalledArchive::integer(const std::string& name, std::int64_t& value, const Range& range) {
  const auto found = head_.integers.find(name);
  if (found == head_.integers.end()) refuse_missing(file_, name);
  require_in(range, static_cast<double>(found->second), file_, name);
  value = found->second;
}

std::vector<std::string> RecalledArchive::require_all_known(const std::vector<std::string>& others) const {
  std::vector<std::string> left;
  for (const std::string& name : arrays_.names) {
    if (asked_.count(name) > 0) continue;
    const bool may_be = std::any_of(others.begin(), others.end(),
                                    [&](const std::string& prefix) { return name.rfind(prefix, 0) == 0; });
    if (!may_be) throw InputError(file_.string(), name, "is unknown", another_version);
    left.push_back(name);
  }
  return left;
}

}  // namespace fsi
