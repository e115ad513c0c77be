#pragma once

#include <CLI/CLI.hpp>

#include "meshes/mesh_command.hpp"

namespace fsi {

/// `fsi-mesh thicken`: grows a wall of given layers on a lumen.
MeshCommand thicken_command(CLI::App& app);

}  // namespace fsi
