#include "parallel/host.hpp"

#include <sched.h>

#include <algorithm>
#include <vector>

#ifdef FSI_WITH_MPI
#include "parallel/mpi_handle.hpp"
#endif

namespace fsi {

namespace {

/// One where this process may run on the core.
std::vector<int> own_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores(CPU_SETSIZE, 0);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return cores;
  for (int core = 0; core < CPU_SETSIZE; ++core) cores[static_cast<std::size_t>(core)] = CPU_ISSET(core, &set) ? 1 : 0;
  return cores;
}

#ifdef FSI_WITH_MPI
/// The processes of this host.
class Host {
 public:
  explicit Host(const Communicator& processes) {
    MPI_Comm_split_type(mpi_of(processes), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &together_);
  }
  ~Host() { MPI_Comm_free(&together_); }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;
  MPI_Comm get() const { return together_; }

 private:
  MPI_Comm together_ = MPI_COMM_NULL;
};
#endif

}  // namespace

int processes_on_host(const Communicator& processes) {
  int count = 1;
#ifdef FSI_WITH_MPI
  if (!processes.is_alone()) MPI_Comm_size(Host(processes).get(), &count);
#else
  static_cast<void>(processes);
#endif
  return count;
}

int own_core_count() {
  const std::vector<int> cores = own_cores();
  return std::max<int>(1, static_cast<int>(std::count(cores.begin(), cores.end(), 1)));
}

int cores_on_host(const Communicator& processes) {
  std::vector<int> cores = own_cores();
#ifdef FSI_WITH_MPI
  if (!processes.is_alone())
    MPI_Allreduce(MPI_IN_PLACE, cores.data(), static_cast<int>(cores.size()), MPI_INT, MPI_MAX, Host(processes).get());
#else
  static_cast<void>(processes);
#endif
  return std::max<int>(1, static_cast<int>(std::count(cores.begin(), cores.end(), 1)));
}

}  // namespace fsi
