#pragma once

#include <CLI/CLI.hpp>

#include "meshes/mesh_command.hpp"

namespace fsi {

/// `fsi-mesh geo`: the mesh of a shape that a gmsh script describes.
MeshCommand geo_command(CLI::App& app);

}  // namespace fsi
