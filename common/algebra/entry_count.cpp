#include "algebra/entry_count.hpp"

#include <fmt/format.h>

#include <limits>

#include "base/error.hpp"

namespace fsi {

int entry_count(std::int64_t entries) {
  constexpr int most = std::numeric_limits<int>::max();
  if (entries <= most) return static_cast<int>(entries);
  throw InputError("", "mesh", fmt::format("a matrix has {} entries, and a process holds at most {}", entries, most),
                   "use more processes, or a coarser mesh");
}

}  // namespace fsi
