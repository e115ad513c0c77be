#pragma once

#include "parallel/communicator.hpp"

namespace fsi {

/// How many of the processes run on the host of this one, it included. For all processes together.
int processes_on_host(const Communicator& processes);

/// How many cores this process may use: its launcher may bind it to some.
int own_core_count();

/// How many cores the processes on the host of this one may use together: launchers bind each to a part of them. For all
/// processes together.
int cores_on_host(const Communicator& processes);

}  // namespace fsi
