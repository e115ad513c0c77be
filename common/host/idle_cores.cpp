#include "host/idle_cores.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

namespace fsi {

namespace {

constexpr auto shortest_look = std::chrono::milliseconds(50);  // five ticks of the kernel's clock

std::string text_of(const char* file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::vector<int> allowed_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (sched_getaffinity(0, sizeof set, &set) == 0)
    for (int core = 0; core < CPU_SETSIZE; ++core)
      if (CPU_ISSET(core, &set)) cores.push_back(core);
  if (cores.empty()) cores.push_back(0);
  return cores;
}

double own_cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

std::vector<long> busy_ticks(const std::string& proc_stat) {
  std::vector<long> ticks;
  std::istringstream lines(proc_stat);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    long user = 0, nice = 0, system = 0, idle = 0, waiting = 0, irq = 0, softirq = 0, steal = 0;
    words >> name >> user >> nice >> system >> idle >> waiting >> irq >> softirq >> steal;
    if (name.size() < 4 || name.compare(0, 3, "cpu") != 0 || words.fail()) continue;
    const std::size_t core = std::stoul(name.substr(3));
    if (ticks.size() <= core) ticks.resize(core + 1, -1);
    ticks[core] = user + nice + system + irq + softirq + steal;
  }
  return ticks;
}

double busy_elsewhere(const std::vector<long>& before, const std::vector<long>& after, const std::vector<int>& cores,
                      double ticks_per_second, double own, double seconds) {
  long busy = 0;
  for (const int core : cores) {
    const auto i = static_cast<std::size_t>(core);
    if (i < after.size() && i < before.size() && after[i] >= 0 && before[i] >= 0) busy += after[i] - before[i];
  }
  return std::max(0.0, (static_cast<double>(busy) / ticks_per_second - own) / seconds);
}

int cgroup_cores(const std::string& text) {
  std::istringstream words(text);
  double quota = 0, period = 0;
  if (!(words >> quota >> period) || quota <= 0 || period <= 0) return 0;
  return std::max(1, static_cast<int>(std::floor(quota / period)));
}

CoreWatch::CoreWatch()
    : cores_(allowed_cores()),
      start_(Clock::now()),
      own_seconds_(own_cpu_seconds()),
      ticks_(busy_ticks(text_of("/proc/stat"))) {}

CoreUse CoreWatch::look() const {
  std::this_thread::sleep_until(start_ + shortest_look);
  const double seconds = seconds_since(start_);
  const auto ticks = busy_ticks(text_of("/proc/stat"));
  CoreUse use;
  use.cores = static_cast<int>(cores_.size());
  use.busy_elsewhere = busy_elsewhere(ticks_, ticks, cores_, static_cast<double>(sysconf(_SC_CLK_TCK)),
                                      own_cpu_seconds() - own_seconds_, seconds);
  const int limit = cgroup_cores(text_of("/sys/fs/cgroup/cpu.max"));
  if (limit > 0) use.cores = std::min(use.cores, limit);
  return use;
}

ThreadChoice choose_threads(int asked, std::size_t tetrahedra, const CoreUse& use) {
  if (asked > 0) return {asked, "as asked"};
  const int busy = static_cast<int>(std::lround(std::min<double>(use.busy_elsewhere, use.cores)));
  const int idle = std::max(1, use.cores - busy);
  const int useful = std::max(1, static_cast<int>(std::min<std::size_t>(tetrahedra / tetrahedra_per_thread, 1 << 20)));
  const auto cores = [](int count) { return std::to_string(count) + (count == 1 ? " core" : " cores"); };
  if (useful < idle) return {useful, "the mesh is too small for more"};
  if (busy > 0) return {idle, "other jobs keep " + cores(busy) + " of " + std::to_string(use.cores) + " busy"};
  return {idle, cores(use.cores) + " idle"};
}

ThreadChoice choose_threads(int asked, std::size_t tetrahedra, const CoreWatch& watch) {
  if (asked > 0 || tetrahedra < 2 * tetrahedra_per_thread) return choose_threads(asked, tetrahedra, CoreUse{2, 0});
  return choose_threads(asked, tetrahedra, watch.look());
}

}  // namespace fsi
