"""Meshes of other programs as gmsh files with named groups: the Python half of fsi-mesh import."""
