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

/// Stresses of the wall, kPa: at its nodes, and behind them at mid-edge nodes once more for each further layer whose
/// vertices there are its own (WallStress::place_of_middle).
struct WallStresses {
  std::vector<Mat3<double>> cauchy;
  std::array<std::vector<double>, 2> of_fibres;  ///< per family, along the deformed fibre; zero without fibres
};

/// The Cauchy stress of the wall, sigma = P F^T / J with the first Piola-Kirchhoff stress P = F S' - p J F^-T of its
/// weak form, from displacement gradients recovered at the nodes and the pressure there (docs/theory.md, section
/// 11a.3). In nearly incompressible layers the recovered gradient is corrected to fulfil the volume condition of the
/// weak form, at nodes whose fit leaves directions out: in those directions. Gradients are recovered on the cells of
/// one layer. Where layers have vertices of their own, each has its own stress; shared vertices have the mean.
template <int n>
class WallStress {
 public:
  virtual ~WallStress() = default;
  /// Collective over the processes that share the wall: each gets the stresses at all its nodes, ghosts too, and behind
  /// them those of its own mid-edge nodes. \param wall  (d, p) of a level, mixed layout
  virtual WallStresses of(const std::vector<double>& wall) const = 0;
  virtual bool has_fibres() const = 0;
  /// Place in WallStresses of a mid-edge node, in the layer to which the edge's ends belong.
  virtual int place_of_middle(int node, std::array<int, 2> ends) const = 0;
};

/// \param mesh   that the scene was built on
/// \param scene  has a wall; must outlive what is made
/// \param whole  whole parts of a mesh that processes share; empty: the scene has them
template <class Element>
std::unique_ptr<WallStress<Element::components>> make_wall_stress(const Case& setup, const MeshOf<Element>& mesh,
                                                                  const Scene<Element::components>& scene,
                                                                  const WholeParts<Element>& whole = {});

}  // namespace fsi
