#pragma once

#include <CLI/CLI.hpp>

#include "meshes/mesh_command.hpp"

namespace fsi {

/// `fsi-mesh adapt`: a mesh that is finer where a run's error indicator is large.
MeshCommand adapt_command(CLI::App& app);

}  // namespace fsi
