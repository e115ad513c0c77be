"""Meshes of other programs, read by meshio, as gmsh files with named groups: the Python half of fsi-mesh import."""
