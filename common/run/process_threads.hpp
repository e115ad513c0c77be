#pragma once

#include <cstddef>
#include <string>

#include "host/idle_cores.hpp"
#include "parallel/communicator.hpp"

namespace fsi {

/// Cores of a host that this process may use, that all processes on it may use together, and how many these are.
struct HostCores {
  int own = 1, all = 1, processes = 1;

  /// The launcher gives each process a part of the cores.
  bool bound() const { return own < all; }
  /// Cores for the threads of a process.
  int of_process() const { return bound() ? own : all / processes > 1 ? all / processes : 1; }
};

/// How many threads one of several processes takes: as asked; else its part of the cores that the processes of its host
/// may use, but no more than its cells keep busy. The load by other jobs is not measured, since it cannot be told from
/// that of these processes. For one process alone as choose_threads(). To be called by all processes.
/// \param cells  of the whole mesh
ThreadChoice threads_of_process(int asked, std::size_t cells, const CoreWatch& watch, const Communicator& processes);

/// The rule for several processes. \param cells  of each
ThreadChoice threads_of_process(int asked, std::size_t cells, const HostCores& host);

}  // namespace fsi
