#include "io/summary.hpp"

#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"

namespace fsi {

nlohmann::json profile_json(const Profile& profile) {
  nlohmann::json json = {{"phases", nlohmann::json::object()}, {"counters", nlohmann::json::object()}};
  for (const auto& [name, phase] : profile.phases())
    json["phases"][name] = {{"seconds", phase.seconds}, {"calls", phase.calls}};
  for (const auto& [name, count] : profile.counters()) json["counters"][name] = count;
  return json;
}

void write_summary(const std::filesystem::path& folder, const nlohmann::json& summary) {
  // Bytes that are not UTF-8 (a title from a shell, say) are replaced, so that a finished run gets its summary.
  write_atomically(folder / "summary.json",
                   summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace fsi
