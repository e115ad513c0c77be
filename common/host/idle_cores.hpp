#pragma once

#include <string>
#include <vector>

#include "base/stopwatch.hpp"

namespace fsi {

/// Cores that this process may use, and how many of them other processes keep busy.
struct CoreUse {
  int cores = 1;
  double busy_elsewhere = 0;
};

/// Busy clock ticks of each core in the text of /proc/stat, by core number; -1 for a core that it does not list.
std::vector<long> busy_ticks(const std::string& proc_stat);

/// Cores that others kept busy between two looks at /proc/stat.
/// \param before, after  busy_ticks
/// \param cores          numbers of those that count
/// \param own            processor seconds that this process used in between, on all cores
/// \param seconds        between the looks
double busy_elsewhere(const std::vector<long>& before, const std::vector<long>& after, const std::vector<int>& cores,
                      double ticks_per_second, double own, double seconds);

/// Whole cores that a cgroup's cpu.max allows, at least 1; 0: no limit. `text` is "max 100000" or "150000 100000".
int cgroup_cores(const std::string& text);

/// Watches the cores from its construction on.
class CoreWatch {
 public:
  CoreWatch();
  /// The mean since the construction. Waits until 50 ms have passed.
  CoreUse look() const;

 private:
  std::vector<int> cores_;  ///< numbers of those this process may run on
  Clock::time_point start_;
  double own_seconds_;
  std::vector<long> ticks_;
};

/// How many threads a run takes, and why.
struct ThreadChoice {
  int count = 1;
  std::string reason;
  std::string warning{};  ///< that threads hold each other up; empty: none
};

/// As asked with --threads; else one per idle core, but at most one per `tetrahedra_per_thread`, and at least one.
/// \param asked  0: not asked
ThreadChoice choose_threads(int asked, std::size_t tetrahedra, const CoreUse& use);
/// The same; measures the cores' use only if the choice depends on it.
ThreadChoice choose_threads(int asked, std::size_t tetrahedra, const CoreWatch& watch);

/// With fewer a further thread costs as much as it saves (docs/guide/running.md#threads).
constexpr std::size_t tetrahedra_per_thread = 10000;

}  // namespace fsi
