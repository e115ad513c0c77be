#pragma once

#include <CLI/CLI.hpp>

#include "meshes/mesh_command.hpp"

namespace fsi {

/// `fsi-mesh import`: a mesh of another program.
MeshCommand import_command(CLI::App& app);

}  // namespace fsi
