#pragma once

#include <cmath>
#include <vector>

#include "fem/element_packs.hpp"
#include "materials/strain.hpp"

namespace fsi {

/// The axis of the wall's cylindrical frame.
struct CylinderAxis {
  Vec3<double> origin{{0, 0, 0}};     ///< mm
  Vec3<double> direction{{0, 0, 1}};  ///< unit length
};

/// Fibre directions a = cos(alpha) e_theta +- sin(alpha) e_z in the local cylindrical frame at the centre of each
/// element (docs/theory.md, section 5.6), [thread][pack]. \param angle  alpha in radians, from the circumference
template <class Element, class Point, class Cell>
std::vector<std::vector<Fibres>> fibre_directions(const ElementPacks<Element>& packs, const std::vector<Point>& x,
                                                  const std::vector<Cell>& cells, const CylinderAxis& axis,
                                                  double angle) {
  std::vector<std::vector<Fibres>> all(packs.thread_count());
  for (int t = 0; t < packs.thread_count(); ++t)
    for (const auto& pack : packs.of_thread(t)) {
      Fibres fibres;
      for (int lane = 0; lane < pack_width; ++lane) {
        const auto& cell = cells[pack.cell[lane]];
        Vec3<double> offset{{0, 0, 0}};
        for (int node : cell)
          for (int i = 0; i < 3; ++i) offset[i] += x[node][i] / Element::nodes;
        for (int i = 0; i < 3; ++i) offset[i] -= axis.origin[i];
        const double along = dot(offset, axis.direction);
        Vec3<double> radial;
        for (int i = 0; i < 3; ++i) radial[i] = offset[i] - along * axis.direction[i];
        const double radius = std::sqrt(dot(radial, radial));
        for (int i = 0; i < 3; ++i) radial[i] /= radius;
        const Vec3<double> circumferential = cross(axis.direction, radial);
        for (int i = 0; i < 3; ++i) {
          const double hoop = std::cos(angle) * circumferential[i], axial = std::sin(angle) * axis.direction[i];
          fibres.direction[0][i].set(lane, hoop + axial);
          fibres.direction[1][i].set(lane, hoop - axial);
        }
      }
      all[t].push_back(fibres);
    }
  return all;
}

}  // namespace fsi
