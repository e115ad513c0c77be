#include "parallel/host.hpp"

#ifdef FSI_WITH_MPI
#include "parallel/mpi_handle.hpp"
#endif

namespace fsi {

int processes_on_host(const Communicator& processes) {
  if (processes.is_alone()) return 1;
  int count = 1;
#ifdef FSI_WITH_MPI
  MPI_Comm together = MPI_COMM_NULL;
  MPI_Comm_split_type(mpi_of(processes), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &together);
  MPI_Comm_size(together, &count);
  MPI_Comm_free(&together);
#endif
  return count;
}

}  // namespace fsi
