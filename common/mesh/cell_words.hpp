#pragma once

namespace fsi {

/// What messages call the parts of a mesh of this dimension.
template <int Dim>
struct CellWords;
template <>
struct CellWords<2> {
  static constexpr const char *cell = "triangle", *cells = "triangles", *facet = "edge", *facets = "edges",
                              *region_group = "physical surface", *facet_group = "physical curve",
                              *facet_command = "Physical Curve", *region_command = "Physical Surface",
                              *regions = "surfaces", *measure = "area", *unit = "mm^2", *mesh_dimensions = "two";
};
template <>
struct CellWords<3> {
  static constexpr const char *cell = "tetrahedron", *cells = "tetrahedra", *facet = "triangle", *facets = "triangles",
                              *region_group = "physical volume", *facet_group = "physical surface",
                              *facet_command = "Physical Surface", *region_command = "Physical Volume",
                              *regions = "volumes", *measure = "volume", *unit = "mm^3", *mesh_dimensions = "three";
};

}  // namespace fsi
