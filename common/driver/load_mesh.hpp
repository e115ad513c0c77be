#pragma once

#include <string>

#include "case/case.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// The mesh of a case: read from its file, or an artery level made on the spot; checked against what the scene needs
/// and renumbered (reverse Cuthill-McKee). Volumes that the scene does not need are left out, save `fluid` under a wall
/// alone: its interface is where the pressure acts. \throws InputError
TetrahedralMesh load_mesh(const Case& setup);

/// What messages and summaries call the mesh: its file, or "level coarse".
std::string mesh_name(const Case& setup);

/// FNV-1a over nodes, cells and regions: tells whether a checkpoint belongs to a mesh.
std::string hash_of_mesh(const TetrahedralMesh& mesh);

}  // namespace fsi
