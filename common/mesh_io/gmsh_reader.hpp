#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "mesh/mesh_fault.hpp"
#include "mesh/simplex_mesh.hpp"
#include "mesh_io/gmsh_file.hpp"

namespace fsi {

/// Reads the cells of the named physical groups from a gmsh file (.msh 4.1 or 2.2, ASCII or binary): tetrahedra of
/// physical volumes for Dim = 3, triangles of physical surfaces for Dim = 2. First-order cells give straight edges;
/// read with Order = 2 they get mid-edge nodes half way. Second-order cells keep their mid-edge nodes with Order = 2
/// and lose them with Order = 1.
///
/// `regions` of the result are `regions_wanted`, in that order. Other groups are left out, and with them the nodes that
/// only they use. `facet_groups` are the named physical surfaces (for Dim = 2 curves) as far as their elements are
/// facets of what was read (facets of left-out cells are dropped, and groups that have none left; `astray` names what
/// else is dropped). Facets are oriented out of the cell they bound; one between two cells that were both read, out of
/// the one in `fluid` if only one is, else out of the first. Nodes keep the order of the file (mid-edge nodes made here
/// come behind them); cells that of the file, too.
///
/// Triangle meshes are returned as (r, 0, z) or (x, y, 0), cells turned counter-clockwise. A file of an axisymmetric
/// mesh lies in the plane y = 0 (r along x, axis along z), as fsi-mesh writes it, or in the plane z = 0 (r along x,
/// axis along y), as it is drawn in gmsh. Radii and coordinates out of the plane that are zero to rounding become zero.
///
/// Throws InputError, naming the file and the group or element at fault, for everything parse_gmsh() throws for and
/// for: no physical names; a wanted group that is missing or empty; a mesh of another dimension; elements in a wanted
/// group that are no tetrahedra (triangles) of first or second order, or of both orders, are in two wanted groups,
/// inverted (tetrahedra), degenerate, or curved so much that their Jacobian is not positive everywhere; unknown or
/// repeated node tags; nodes that no element uses; cells or facets of a surface that are there twice; elements of
/// surfaces with a meaning (group_names.hpp) that are no facet of any cell; triangles out of the plane, or with a negative
/// radius.
/// \param geometry  of triangle meshes
/// \param faults  where it is given, unused nodes and inverted, degenerate, folded and repeated cells are no error:
///         each kind is an entry here, which names the first one
template <int Dim = 3, int Order = 1>
SimplexMesh<Dim, Order> read_gmsh(const std::filesystem::path& path, const std::vector<std::string>& regions_wanted,
                                  TriangleGeometry geometry = TriangleGeometry::axisymmetric,
                                  std::vector<MeshFault>* faults = nullptr);

/// A mesh of any dimension and order that the programs know.
using AnyMesh = std::variant<SimplexMesh<2, 1>, SimplexMesh<2, 2>, SimplexMesh<3, 1>, SimplexMesh<3, 2>>;

/// read_gmsh() of a dimension and an order that are known at run time.
AnyMesh read_gmsh(const std::filesystem::path& path, const std::vector<std::string>& regions_wanted, int dimension,
                  int order, TriangleGeometry geometry);

/// Names of the file's physical groups of a dimension, in the file's order: a case file gives materials to volumes (3)
/// of a three-dimensional mesh and to surfaces (2) of a two-dimensional one. Throws as parse_gmsh().
std::vector<std::string> gmsh_regions(const std::filesystem::path& path, int dimension);

/// Highest dimension of the file's physical groups, 0 when it names none: 3 for a mesh of volumes, 2 for one of
/// surfaces.
int gmsh_dimension(const std::filesystem::path& path);
int gmsh_dimension(const GmshFile& file);

/// Order of the file's cells of a dimension: 2 where there are some of second order or more, else 1.
int gmsh_order(const GmshFile& file, int dimension);

/// A cell is degenerate when its volume is below this fraction of its longest edge cubed (regular tetrahedron: 0.118);
/// a triangle when its area is below this fraction of its longest edge squared.
inline constexpr double smallest_relative_volume = 1e-12;

}  // namespace fsi
