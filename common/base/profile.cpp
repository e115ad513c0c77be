#include "base/profile.hpp"

#include <sys/resource.h>

#include <fstream>
#include <string>

namespace fsi {

double peak_memory_mib() {
  constexpr double kib_per_mib = 1024;
  // getrusage() also counts what the launcher held when it started this program; VmHWM does not.
  std::ifstream status("/proc/self/status");
  for (std::string key; status >> key; status.ignore(1000, '\n')) {
    double kib = 0;
    if (key == "VmHWM:" && status >> kib) return kib / kib_per_mib;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / kib_per_mib;  // Linux counts in KiB
}

}  // namespace fsi
