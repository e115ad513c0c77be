#include "host/machine.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <sstream>

namespace fsi {

namespace {

/// The value behind the first line with this key; empty where there is none.
std::string value_of(const std::string& key, const std::string& proc_cpuinfo) {
  std::istringstream lines(proc_cpuinfo);
  for (std::string line; std::getline(lines, line);) {
    const auto colon = line.find(':');
    if (colon == std::string::npos || line.rfind(key, 0) != 0) continue;
    if (line.find_first_not_of(" \t", key.size()) != colon) continue;
    const auto first = line.find_first_not_of(" \t", colon + 1);
    if (first != std::string::npos) return line.substr(first, line.find_last_not_of(" \t\r") + 1 - first);
  }
  return {};
}

}  // namespace

std::string processor_in(const std::string& proc_cpuinfo) {
  std::string model = value_of("model name", proc_cpuinfo);
  if (!model.empty()) return model;
  // Arm's kernels give numbers instead, of the maker and of its design.
  const std::string maker = value_of("CPU implementer", proc_cpuinfo), part = value_of("CPU part", proc_cpuinfo);
  if (maker.empty() || part.empty()) return "unknown";
  return fmt::format("Arm, implementer {}, part {}", maker, part);
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  return processor_in({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
}

std::string compiler() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

}  // namespace fsi
