#include "run/process_threads.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "parallel/host.hpp"

namespace fsi {

ThreadChoice part_of_cores(int cores, int processes, std::size_t cells) {
  const int part = std::max(1, cores / processes);
  const auto useful = std::max<std::size_t>(1, cells / tetrahedra_per_thread);
  if (useful < static_cast<std::size_t>(part)) return {static_cast<int>(useful), "the mesh is too small for more"};
  return {part, fmt::format("{} {} for {} {} on a host", cores, cores == 1 ? "core" : "cores", processes,
                            processes == 1 ? "process" : "processes")};
}

ThreadChoice threads_of_process(int asked, std::size_t cells, const CoreWatch& watch, const Communicator& processes) {
  if (asked > 0 || processes.is_alone()) return choose_threads(asked, cells, watch);
  const int here = processes_on_host(processes);
  return part_of_cores(cores_on_host(processes), here, cells / static_cast<std::size_t>(processes.size()));
}

}  // namespace fsi
