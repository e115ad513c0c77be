#pragma once

#include "meshes/mesh_command.hpp"

namespace fsi {

/// `fsi-mesh lumen`: a segmented surface as it comes, made a mesh of the lumen.
MeshCommand lumen_command(CLI::App& app);

}  // namespace fsi
