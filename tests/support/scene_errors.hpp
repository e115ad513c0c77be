#pragma once

#include <cmath>
#include <vector>

#include "mesh/submesh.hpp"
#include "support/exact_fields.hpp"

namespace fsi::test {

/// Relative L2 error of a field, gathered point by point.
struct RelativeError {
  double difference = 0, size = 0;
  void add(double weight, double computed, double exact) {
    difference += weight * (computed - exact) * (computed - exact);
    size += weight * exact * exact;
  }
  double value() const { return std::sqrt(difference / size); }
};

/// The cells of one region of a part as a mesh, node numbers as in the part.
template <class Element>
SimplexMesh<Element::dim, Element::order> cells_of(const Submesh<Element::dim, Element::order>& part, int region) {
  SimplexMesh<Element::dim, Element::order> mesh;
  mesh.nodes = part.nodes;
  for (std::size_t c = 0; c < part.cells.size(); ++c)
    if (part.cell_region[c] == region) mesh.cells.push_back(part.cells[c]);
  return mesh;
}

/// Adds the errors of a mixed field's vectors and scalars on the cells of one region.
/// \param vector  exact value at a reference position, a Point with all three components in space
/// \param scalar  likewise, a number
/// \param mesh    a mesh displacement, n numbers a node, by which positions are moved; null: none
template <class Element, class Vector, class Scalar>
void add_errors(const Submesh<Element::dim, Element::order>& part, int region, const std::vector<double>& field,
                Vector vector, Scalar scalar, RelativeError& of_vectors, RelativeError& of_scalars,
                const std::vector<double>* mesh = nullptr) {
  constexpr int n = Element::components;
  visit_points<Element>(cells_of<Element>(part, region), [&](const auto& cell, const ElementPoint<Element>& p) {
    Point x = p.x;
    if (mesh) {
      const auto moved = discrete_vector<Element>(*mesh, n, cell, p);
      for (int i = 0; i < 3; ++i) x[i] += moved.value[i][0];
    }
    const Point exact = vector(x);
    const auto computed = discrete_vector<Element>(field, n + 1, cell, p);
    for (int i = 0; i < 3; ++i) of_vectors.add(p.weight, computed.value[i][0], exact[i]);
    double value = 0;
    for (int a = 0; a < Element::scalar_nodes; ++a) value += p.scalar_shape[a] * field[MixedLayout<n>::scalar(cell[a])];
    of_scalars.add(p.weight, value, scalar(x));
  });
}

}  // namespace fsi::test
