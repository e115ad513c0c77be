#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "fem/element_packs.hpp"
#include "materials/strain.hpp"
#include "wall/fibre_frame.hpp"

namespace fsi {

/// The axis of the wall's cylindrical frame.
struct CylinderAxis {
  Vec3<double> origin{{0, 0, 0}};     ///< mm
  Vec3<double> direction{{0, 0, 1}};  ///< unit length
};

/// Fibre directions in the elements of a layer, at each quadrature point, [thread][pack][point].
template <class Element>
using FibreField = std::vector<std::vector<std::array<Fibres, Element::points>>>;

/// a = cos(alpha) e_theta +- sin(alpha) e_z in the cylindrical frame at a point (docs/theory.md, section 5.6).
/// \param x      mm, off the axis
/// \param angle  alpha in radians, from the circumference
inline std::array<Vec3<double>, 2> fibre_directions_at(const Vec3<double>& x, const CylinderAxis& axis, double angle) {
  const Vec3<double> offset = x - axis.origin;
  const Vec3<double> radial = offset - dot(offset, axis.direction) * axis.direction;
  const Vec3<double> around = cross(axis.direction, radial);  // the radius times e_theta
  const double cosine = std::cos(angle) / std::sqrt(dot(radial, radial)), sine = std::sin(angle);
  return {cosine * around + sine * axis.direction, cosine * around - sine * axis.direction};
}

/// The directions at the isoparametric positions of the elements' quadrature points.
/// \param x     reference coordinates of the nodes, mm
/// \param axis  of tetrahedra; of triangles in a plane its origin counts, since it stands upright on them; a body of
///              revolution has its own: there a = (0, cos(alpha), +-sin(alpha)) everywhere
template <class Element, class Point, class Cell>
FibreField<Element> fibre_directions(const ElementPacks<Element>& packs, const std::vector<Point>& x,
                                     const std::vector<Cell>& cells, CylinderAxis axis, double angle) {
  if constexpr (Element::dim == 2) axis.direction = {{0, 0, 1}};
  if constexpr (Element::axisymmetric) axis.origin = {{0, 0, 0}};
  FibreField<Element> all(packs.thread_count());
  for (int t = 0; t < packs.thread_count(); ++t)
    for (const auto& pack : packs.of_thread(t)) {
      all[t].emplace_back();
      for (int q = 0; q < Element::points; ++q) {
        const auto shapes = Element::at(pack.geometry, q).vectors();
        for (int lane = 0; lane < pack_width; ++lane) {
          Vec3<double> at{{0, 0, 0}};
          for (int a = 0; a < Element::nodes; ++a)
            for (int i = 0; i < 3; ++i) at[i] += shapes.value[a] * x[cells[pack.cell[lane]][a]][i];
          const auto directions = fibre_directions_at(at, axis, angle);
          for (int family = 0; family < 2; ++family)
            for (int i = 0; i < 3; ++i) all[t].back()[q].direction[family][i].set(lane, directions[family][i]);
        }
      }
    }
  return all;
}

/// The directions in the frame of the wall's potentials. In two dimensions the direction that stands upright on the
/// plane is the axial one of plane scenes and the circumferential one of a body of revolution.
/// \param cells  of the wall's part, as the packs name them
template <class Element>
FibreField<Element> fibre_directions(const ElementPacks<Element>& packs, const FrameFields& fields,
                                     const std::vector<std::array<int, Element::nodes>>& cells, double angle);

}  // namespace fsi
