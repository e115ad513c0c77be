#pragma once

#include <cstddef>

#include "host/idle_cores.hpp"
#include "parallel/communicator.hpp"

namespace fsi {

/// How many threads one of several processes takes: as asked; else its part of the cores that the processes of its host may
/// use, but none with fewer cells of its own than are of use. Others' jobs are not looked at, since these processes cannot
/// be told from them. Alone as choose_threads(). For all processes together.
/// \param cells  of the whole mesh
ThreadChoice threads_of_process(int asked, std::size_t cells, const CoreWatch& watch, const Communicator& processes);

/// The rule: `cores` of a host for `processes` there, `cells` of each.
ThreadChoice part_of_cores(int cores, int processes, std::size_t cells);

}  // namespace fsi
