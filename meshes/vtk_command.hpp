#pragma once

#include "meshes/mesh_command.hpp"

namespace fsi {

/// `fsi-mesh vtk-arrays FILE`, which `fsi-mesh import` asks for: what a file of VTK's XML formats holds, on the standard
/// output. A line of JSON: `points`, `cells`, `corners`, how many; `lines` (of surfaces, vertices too), `strips`; `surface`,
/// whether it is a .vtp; `fields`, each with `name`, `of_cells` and `numbers`, how many; `left_out`, those of more or other
/// than one number a place. Then, as 64 bits of this machine: coordinates; ends of the cells in the corners, VTK's kinds of
/// the cells, corners; numbers of each field. A field that some piece does not have is none of the mesh.
MeshCommand vtk_command(CLI::App& app);

}  // namespace fsi
