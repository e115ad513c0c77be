#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "base/profile.hpp"

namespace fsi {

/// A profile as JSON: {"phases": {NAME: {"seconds", "calls"}}, "counters": {NAME: count}}
nlohmann::json profile_json(const Profile& profile);

/// DIR/summary.json, replaced atomically. The drivers write it at the start with "status": "running", at the end with
/// "done", "not converged" or "interrupted". \throws WriteError when the file cannot be written
void write_summary(const std::filesystem::path& folder, const nlohmann::json& summary);

}  // namespace fsi
