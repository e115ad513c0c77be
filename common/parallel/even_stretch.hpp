#pragma once

#include <cstdint>

#include "parallel/communicator.hpp"

namespace fsi {

/// A process's stretch of items that all processes have, or that all know the number of: items first to last - 1.
/// Stretches follow each other in the order of the processes, and are as long as each other but for one item.
struct EvenStretch {
  std::int64_t first = 0, last = 0;

  EvenStretch(std::int64_t items, const Communicator& processes)
      : first(items * processes.rank() / processes.size()), last(items * (processes.rank() + 1) / processes.size()) {}

  std::int64_t count() const { return last - first; }
};

}  // namespace fsi
