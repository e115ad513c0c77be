#include "run/process_threads.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "parallel/host.hpp"

namespace fsi {

namespace {

std::string counted(int count, const char* one, const char* several) {
  return fmt::format("{} {}", count, count == 1 ? one : several);
}

std::string cores(int count) {
  return counted(count, "core", "cores");
}

ThreadChoice part_of_cores(std::size_t cells, const HostCores& host) {
  const auto useful = std::max<std::size_t>(1, cells / tetrahedra_per_thread);
  if (useful < static_cast<std::size_t>(host.of_process()))
    return {static_cast<int>(useful), "the mesh is too small for more"};
  return {host.of_process(),
          fmt::format("{} for {} on a host", cores(host.all), counted(host.processes, "process", "processes"))};
}

}  // namespace

ThreadChoice threads_of_process(int asked, std::size_t cells, const HostCores& host) {
  ThreadChoice choice = asked > 0 ? ThreadChoice{asked, "as asked"} : part_of_cores(cells, host);
  choice.reason += host.bound() ? fmt::format("; the launcher binds each process to {}", cores(host.own))
                                : "; processes are not bound to cores";
  if (choice.count > 1 && choice.count > host.of_process()) {
    const std::string each = fmt::format("{} threads of each process share {}", choice.count, cores(host.of_process()));
    choice.warning = host.bound()
                         ? fmt::format(
                               "{}, since the launcher binds it there: start the run by mpirun --map-by slot:PE={} "
                               "--bind-to core, or with --threads {}",
                               each, choice.count, host.own)
                         : fmt::format("{}: start fewer processes, or --threads {}", each, host.of_process());
  }
  return choice;
}

ThreadChoice threads_of_process(int asked, std::size_t cells, const CoreWatch& watch, const Communicator& processes) {
  if (processes.is_alone()) return choose_threads(asked, cells, watch);
  const HostCores host{own_core_count(), cores_on_host(processes), processes_on_host(processes)};
  return threads_of_process(asked, cells / static_cast<std::size_t>(processes.size()), host);
}

}  // namespace fsi
