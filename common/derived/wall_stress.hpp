#pragma once

#include <array>
#include <memory>
#include <vector>

#include "case/case.hpp"
#include "math/tensor.hpp"
#include "scene/boundary_conditions.hpp"
#include "scene/build_scene.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Stresses at the wall's nodes, kPa. Only vertices have them: between these they are linear, as the wall's pressure is.
struct WallStresses {
  std::vector<Mat3<double>> cauchy;              ///< per node; zero at mid-edge nodes
  std::array<std::vector<double>, 2> of_fibres;  ///< per node and family, along the deformed fibre; zero without fibres
};

/// The Cauchy stress of the wall, sigma = P F^T / J with the first Piola-Kirchhoff stress P = F S' - p J F^-T of its
/// weak form, from displacement gradients recovered at the vertices and the pressure there (docs/theory.md, section 11a).
/// Gradients are recovered on the cells of one layer. Where layers have vertices of their own, each has its own stress;
/// a vertex that layers share has their mean. All processes that share the wall ask together, and each gets the stresses at
/// all its nodes, ghosts too.
template <int n>
class WallStress {
 public:
  virtual ~WallStress() = default;
  /// \param wall  (d, p) of a level, mixed layout
  virtual WallStresses of(const std::vector<double>& wall) const = 0;
  virtual bool has_fibres() const = 0;
};

/// \param mesh   that the scene was built on
/// \param whole  parts of a mesh that is shared out; empty: the scene has them
template <class Element>
std::unique_ptr<WallStress<Element::components>> make_wall_stress(const Case& setup, const MeshOf<Element>& mesh,
                                                                  const Scene<Element::components>& scene,
                                                                  const WholeParts<Element>& whole = {});

}  // namespace fsi
