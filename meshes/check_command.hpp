#pragma once

#include <CLI/CLI.hpp>

#include "meshes/mesh_command.hpp"

namespace fsi {

/// `fsi-mesh check`: what is wrong with a mesh or a surface, and what mends it.
MeshCommand check_command(CLI::App& app);

}  // namespace fsi
