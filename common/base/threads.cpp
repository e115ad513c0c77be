#include "base/threads.hpp"

#include <omp.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

namespace fsi {

namespace {
int current = 0;
}

int set_threads(int count) {
  current = count > 0 ? count : omp_get_num_procs();
  omp_set_dynamic(0);
  omp_set_num_threads(current);
  return current;
}

int threads() {
  return current > 0 ? current : set_threads(0);
}

void wait_briefly(const char* const* argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  if (setenv("GOMP_SPINCOUNT", "1000", 1) != 0) return;
  std::array<char, 4096> file{};  // by its name: "/proc/self/exe" would be the name that ps shows
  if (readlink("/proc/self/exe", file.data(), file.size() - 1) > 0) execv(file.data(), const_cast<char* const*>(argv));
  // Where that is not possible the run goes on as it is.
}

}  // namespace fsi
