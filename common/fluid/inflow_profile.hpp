#pragma once

#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A surface that fluid is let in through, on one part of a mesh.
template <class Element>
struct InflowOpening {
  using Facet = typename SimplexMesh<Element::dim, Element::order>::Facet;
  std::string name;            ///< the surface's
  std::vector<Point> nodes;    ///< of the part, reference positions, mm
  std::vector<Facet> facets;   ///< of the opening, in the part's numbers, normals outward
  std::vector<char> sticking;  ///< per node of the part: no slip there, as on the opening's rim
  std::string file{};          ///< that messages name
};

/// A velocity on an opening whose discrete flow into the fluid is one: its dot product with normal_weights()
/// (fem/facet_load.hpp) is -1, but for rounding. Times a flow rate in mm^3/ms (axisymmetric: through the whole circle;
/// plane: through 1 mm of thickness; with planes of symmetry: through the part that is meshed) it is the velocity of
/// that flow in mm/ms. It lies along the opening's mean inward normal and is zero off the opening and where the fluid
/// sticks.
struct UnitInflow {
  std::vector<double> velocity;  ///< vector layout, 1/mm^2
  std::string instead;           ///< a sentence: what was taken in place of what was asked for; empty: nothing
};

/// One velocity wherever the fluid does not stick.
/// \throws InputError when the fluid sticks at every node of the opening, or its mean normal is zero
template <class Element>
UnitInflow plug_inflow(const InflowOpening<Element>& opening);

/// Fully developed steady flow. Where the opening is a circle or a sector of one between planes of symmetry (3D), a
/// circle about the axis (axisymmetric) or a straight segment (plane) the parabola 1 - (r/R)^2. Else the solution of
///   -Laplace w = 1 on the opening, w = 0 where the fluid sticks,
/// with the velocity's shape functions on the opening's facets, and `instead` says so. Where the fluid sticks nowhere,
/// a plug (docs/theory.md, section 3.6).
/// \throws InputError as plug_inflow()
template <class Element>
UnitInflow parabolic_inflow(const InflowOpening<Element>& opening);

/// A parabola along each side of a flat rectangle, (1 - (s/h)^2) (1 - (t/k)^2), as benchmarks prescribe it in ducts, where
/// it is not the fully developed flow. Where a side is a plane of symmetry the parabola's top is there (docs/theory.md,
/// section 3.6).
/// \throws InputError as plug_inflow(), and when the opening is no rectangle (rectangle_of(), fluid/opening_shape.hpp)
template <class Element>
UnitInflow biparabolic_inflow(const InflowOpening<Element>& opening);

}  // namespace fsi
