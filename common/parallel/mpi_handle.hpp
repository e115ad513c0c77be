#pragma once

#include <mpi.h>

#include "parallel/communicator.hpp"

namespace fsi {

struct Communicator::Handle {
  MPI_Comm communicator = MPI_COMM_NULL;
};

/// MPI must have begun (ProcessGroup::require_mpi()).
inline MPI_Comm mpi_of(const Communicator& processes) {
  return processes.handle() ? processes.handle()->communicator : MPI_COMM_SELF;
}

}  // namespace fsi
