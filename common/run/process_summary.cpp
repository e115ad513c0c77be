#include "run/process_summary.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/profile.hpp"
#include "fem/dimensions.hpp"
#include "host/threads.hpp"
#include "system/numbering.hpp"

namespace fsi {

namespace {

nlohmann::json spread(const Communicator& processes, double mine) {
  const auto all = processes.gather(mine);
  double sum = 0;
  for (const double one : all) sum += one;
  return {{"minimum", *std::min_element(all.begin(), all.end())},
          {"mean", sum / static_cast<double>(all.size())},
          {"maximum", *std::max_element(all.begin(), all.end())}};
}

struct Nodes {
  std::int64_t owned = 0, halo = 0;
};

template <class Medium>
Nodes nodes_of(const Medium& medium) {
  Nodes nodes;
  for (int a = 0; medium && a < medium->node_count(); ++a) ++(medium->nodes().owns(a) ? nodes.owned : nodes.halo);
  return nodes;
}

/// Numberings of the media by themselves.
template <int n>
std::vector<Numbering> numberings(const Scene<n>& scene) {
  return {scene.fluid ? number_fluid(scene) : Numbering(), scene.wall ? number_wall(scene) : Numbering(),
          scene.coupled() ? number_mesh_motion(scene) : Numbering()};
}

}  // namespace

template <int n>
SceneSize size_of(const Scene<n>& scene) {
  const Communicator& processes = scene.processes();
  const auto of = numberings(scene);
  SceneSize size;
  size.fluid_nodes = processes.sum(nodes_of(scene.fluid).owned);
  size.wall_nodes = processes.sum(nodes_of(scene.wall).owned);
  size.interface_nodes = processes.sum(static_cast<std::int64_t>(scene.owned_interface()));
  size.fluid_unknowns = of[0].whole_size();
  size.wall_unknowns = of[1].whole_size();
  size.mesh_unknowns = of[2].whole_size();
  return size;
}

template <int n>
ProcessSummary<n>::ProcessSummary(const Scene<n>& scene) : scene_(scene), reading_memory_(peak_memory_mib()) {
  if (scene.processes().is_alone()) return;
  for (const Numbering& numbering : numberings(scene))
    halo_unknowns_ += static_cast<std::int64_t>(numbering.ghosts.size());
}

template <int n>
void ProcessSummary<n>::steps_begin() {
  before_ = scene_.processes().traffic();
}

template <int n>
void ProcessSummary<n>::leave_out_since(const Traffic& before) {
  const Traffic& now = scene_.processes().traffic();
  before_.messages += now.messages - before.messages;
  before_.bytes += now.bytes - before.bytes;
  before_.reductions += now.reductions - before.reductions;
}

template <int n>
nlohmann::json ProcessSummary<n>::json(std::int64_t steps, double seconds) const {
  const Communicator& processes = scene_.processes();
  const Traffic now = processes.traffic();
  const double share = steps > 0 ? 1.0 / static_cast<double>(steps) : 0;
  const auto per_step = [share](std::int64_t from, std::int64_t to) { return share * static_cast<double>(to - from); };
  const Nodes fluid = nodes_of(scene_.fluid), wall = nodes_of(scene_.wall);
  std::set<int> neighbours;
  const auto add = [&](const auto& medium) {
    if (medium && medium->nodes().share)
      for (const auto& neighbour : medium->nodes().share->exchange.neighbours()) neighbours.insert(neighbour.rank);
  };
  add(scene_.fluid);
  add(scene_.wall);

  nlohmann::json json;
  const auto say = [&](const char* name, auto mine) { json[name] = spread(processes, static_cast<double>(mine)); };
  say("threads", threads());
  say("step_seconds", share * seconds);
  say("peak_memory_MiB", peak_memory_mib());
  say("reading_memory_MiB", reading_memory_);
  say("owned_nodes", fluid.owned + wall.owned);
  say("halo_nodes", fluid.halo + wall.halo);
  say("halo_unknowns", halo_unknowns_);
  say("neighbours", neighbours.size());
  say("messages_per_step", per_step(before_.messages, now.messages));
  say("bytes_per_step", per_step(before_.bytes, now.bytes));
  json["reductions_per_step"] = per_step(before_.reductions, now.reductions);

  // The first process says which phases there are.
  std::string names;
  for (const auto& [name, phase] : scene_.profile.phases()) names += name + "\n";
  processes.broadcast(names);
  json["phases"] = nlohmann::json::object();
  std::istringstream lines(names);
  const auto& mine = scene_.profile.phases();
  for (std::string name; std::getline(lines, name);) {
    const auto found = mine.find(name);
    json["phases"][name] = spread(processes, found == mine.end() ? 0.0 : found->second.seconds);
  }
  return json;
}

#define FSI_INSTANTIATE(n)                        \
  template SceneSize size_of<n>(const Scene<n>&); \
  template class ProcessSummary<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
