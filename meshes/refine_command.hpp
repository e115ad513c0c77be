#pragma once

#include <CLI/CLI.hpp>

#include "meshes/mesh_command.hpp"

namespace fsi {

/// `fsi-mesh refine`: a mesh of cells half as long.
MeshCommand refine_command(CLI::App& app);

}  // namespace fsi
