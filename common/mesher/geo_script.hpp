#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "mesh_io/gmsh_reader.hpp"
#include "mesher/size_field.hpp"

namespace fsi {

/// The mesh of a shape that a gmsh script describes (.geo, https://gmsh.info/doc/texinfo/gmsh.html), made by the gmsh
/// library: cells of its physical volumes, or surfaces where it has no volume, with the groups of their boundary. The
/// same script gives the same mesh.
/// \param numbers  constants of the script (DefineConstant) that get other values
/// \param order    1: straight edges; 2: quadratic cells with nodes on the shape
/// \param near     the file that the mesh is for: a temporary one is written beside it
/// \param sizes    of the cells, in place of all sizes of the script; null: the script's
/// \throws InputError for a script that is missing, is refused by gmsh, defines no physical groups or not a constant of
///         `numbers`, and for what read_gmsh() refuses
AnyMesh mesh_of_geo_script(const std::filesystem::path& script, const std::map<std::string, double>& numbers, int order,
                           const std::filesystem::path& near, const SizeField* sizes = nullptr);

}  // namespace fsi
