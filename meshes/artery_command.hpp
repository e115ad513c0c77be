#pragma once

#include <CLI/CLI.hpp>

#include "meshes/mesh_command.hpp"

namespace fsi {

/// `fsi-mesh artery`: a straight two-layer artery.
MeshCommand artery_command(CLI::App& app);

}  // namespace fsi
