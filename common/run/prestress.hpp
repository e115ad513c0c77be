#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "case/case.hpp"
#include "io/checkpoint.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Puts the scene's wall under the case's prestress: that of an earlier run where the case names its file, else it is
/// found. Returns what a run keeps of it.
/// \param goes_on  told how far the search has come; may be empty
/// \throws InputError for a file that belongs to another wall, mesh or load; ConvergenceError
template <int n>
Checkpoint apply_prestress(const Case& setup, const std::string& mesh_hash, Scene<n>& scene,
                           const std::function<void(const std::string&)>& goes_on = {});

/// FOLDER/prestress.h5
std::filesystem::path prestress_file(const std::filesystem::path& folder);

}  // namespace fsi
