#include "parallel/end_together.hpp"

#include "parallel/communicator.hpp"

#ifdef FSI_WITH_MPI
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <thread>
#include <vector>

#include "parallel/mpi_handle.hpp"
#endif

namespace fsi {

#ifdef FSI_WITH_MPI

bool all_end_with(int exit_code, double seconds) {
  const Communicator& world = Communicator::world();
  if (world.is_alone()) return true;
  // Messages of this tag are not mixed with what processes say while they work.
  constexpr int tag = 4711;
  MPI_Comm communicator = mpi_of(world);
  static int mine = 0;  // the requests may outlive this call
  static std::vector<int> codes;
  mine = exit_code;
  codes.assign(static_cast<std::size_t>(world.size()), exit_code);
  std::vector<MPI_Request> requests;
  for (int rank = 0; rank < world.size(); ++rank) {
    if (rank == world.rank()) continue;
    MPI_Irecv(&codes[static_cast<std::size_t>(rank)], 1, MPI_INT, rank, tag, communicator, &requests.emplace_back());
    MPI_Isend(&mine, 1, MPI_INT, rank, tag, communicator, &requests.emplace_back());
  }
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  for (int came = 0; came == 0; std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
    MPI_Testall(static_cast<int>(requests.size()), requests.data(), &came, MPI_STATUSES_IGNORE);
    if (came == 0 && std::chrono::steady_clock::now() > end) return false;
  }
  return std::all_of(codes.begin(), codes.end(), [exit_code](int code) { return code == exit_code; });
}

#else

bool all_end_with(int, double) {
  return true;
}

#endif

}  // namespace fsi
