#include "host/threads.hpp"

#include <omp.h>
#include <unistd.h>

#include "host/begin_again.hpp"

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
  begin_again_with_settings(argv, environ);
}

}  // namespace fsi
