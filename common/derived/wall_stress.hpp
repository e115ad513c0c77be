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

/// Stresses of the wall, kPa: at its nodes, and behind them at mid-edge nodes once more for each further layer that has
/// them with vertices of its own (WallStress::place_of_middle).
struct WallStresses {
  std::vector<Mat3<double>> cauchy;
  std::array<std::vector<double>, 2> of_fibres;  ///< per family, along the deformed fibre; zero without fibres
};

/// The Cauchy stress of the wall, sigma = P F^T / J with the first Piola-Kirchhoff stress P = F S' - p J F^-T of its
/// weak form, from displacement gradients recovered at the nodes and the pressure there (docs/theory.md, section 11a.3).
/// In nearly incompressible layers the volume condition of the weak form holds at each node: what the recovered gradient
/// misses of it is added in the directions that recovery knows least.
/// Gradients are recovered on the cells of one layer. Where layers have vertices of their own, each has its own stress;
/// a vertex that layers share has their mean. All processes that share the wall ask together, and each gets the stresses at
/// all its nodes, ghosts too; behind them those of its own mid-edge nodes.
template <int n>
class WallStress {
 public:
  virtual ~WallStress() = default;
  /// \param wall  (d, p) of a level, mixed layout
  virtual WallStresses of(const std::vector<double>& wall) const = 0;
  virtual bool has_fibres() const = 0;
  /// Where stresses have a mid-edge node of the layer to which the edge's ends belong.
  virtual int place_of_middle(int node, std::array<int, 2> ends) const = 0;
};

/// \param mesh   that the scene was built on
/// \param whole  parts of a mesh that is shared out; empty: the scene has them
template <class Element>
std::unique_ptr<WallStress<Element::components>> make_wall_stress(const Case& setup, const MeshOf<Element>& mesh,
                                                                  const Scene<Element::components>& scene,
                                                                  const WholeParts<Element>& whole = {});

}  // namespace fsi
