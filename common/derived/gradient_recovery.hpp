#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "derived/recovery_patches.hpp"
#include "math/tensor.hpp"
#include "mesh/far_nodes.hpp"

namespace fsi {

/// Gradients of nodal fields at nodes, by polynomial-preserving recovery [Zhang2005]: a polynomial of a degree above
/// the element's is fitted by least squares to the nodal values on the cells around a node, and its gradient taken
/// there. Exact for fields that are such polynomials, at the boundary as well as inside: of order 2 for linear and 3
/// for quadratic elements, where the gradient of the finite-element function itself has order 1 and 2.
///
/// Of patches of one to four rings of cells the first is taken whose GradientFit::amplification() is at most
/// `largest_amplification`; a larger one instead if that is above `good_amplification` and the larger one has less than
/// half its remainder. Where no patch is as good, as in a layer one linear element thick, directions that the patch
/// cannot distinguish are left out, the weakest first; the polynomial always has the element's own degree. There the
/// gradient has the order of the element's own. At planes of symmetry patches are continued by mirror images, so that
/// they have two sides. All this depends on lengths and angles alone: a rotated or mirrored body has rotated or
/// mirrored gradients.
///
/// The weights depend on reference positions alone and are found once; a gradient is then a short sum.
///
/// Where processes share a medium, the weights are found on all of its cells, and each process keeps those of nodes
/// that it holds. Patches reach further than these nodes: fields then need values at far nodes, too (reach()).
class GradientRecovery {
 public:
  /// From measured errors: on an unstructured bend (docs/evidence/orders.md#orders-11a-1) the largest error of a wall's
  /// stress grows by a fifth with 20, and with 10 corners of a cube have no patch.
  static constexpr double largest_amplification = 14, good_amplification = 8;

  /// \param at  nodes of the cells, each once: where gradients are wanted
  GradientRecovery(const RecoveryCells& cells, std::vector<int> at);

  /// Renumbers nodes from those of the whole part to those of this process, which must hold the nodes of the gradients.
  /// Collective over processes.
  void restrict_to(const PartRestriction& here);

  /// The field with values at far nodes, as gradient() needs it; an empty one stays empty. Collective over processes.
  /// \param buffer  storage, which may be returned
  template <class Layout>
  const std::vector<double>& reach(const std::vector<double>& field, std::vector<double>& buffer) const {
    if (!far_ || field.empty()) return field;
    buffer = far_->with_far<Layout>(field);
    return buffer;
  }

  const std::vector<int>& nodes() const { return at_; }
  std::size_t size() const { return at_.size(); }
  /// Nodes at which the polynomial is without some directions of the degree above the element's.
  std::size_t fallbacks() const { return fallbacks_; }

  /// GradientFit::error_directions() in space, of trace one; zero where no direction is left out.
  const Mat3<double>& error_directions(std::size_t i) const { return error_directions_[i]; }

  /// Gradient of the field's vectors at entry i of nodes(): (i, j) = d u_i / d X_j in space, with u_r / r in (1, 1) of
  /// bodies of revolution.
  /// \param field    from reach()
  /// \tparam Layout  of the field (fem/nodal_layout.hpp), its vectors of `axes.size()` components
  template <class Layout>
  Mat3<double> gradient(std::size_t i, const std::vector<double>& field) const {
    Mat3<double> h{};
    for (std::size_t k = offsets_[i]; k < offsets_[i + 1]; ++k)
      for (std::size_t c = 0; c < axes_.size(); ++c) {
        const double value = at_image<Layout>(k, static_cast<int>(c), field);
        for (std::size_t j = 0; j < axes_.size(); ++j) h(axes_[c], axes_[j]) += weights_[k][j] * value;
      }
    if (axisymmetric_)
      h(1, 1) = radius_[i] > 0 ? field[Layout::vector(at_[i], 0)] / radius_[i] : h(0, 0);  // its limit on the axis
    return h;
  }

  /// Gradient of the field's scalars, d p / d X_j in space. \param field  from reach()
  template <class Layout>
  Vec3<double> scalar_gradient(std::size_t i, const std::vector<double>& field) const {
    Vec3<double> slope{};
    for (std::size_t k = offsets_[i]; k < offsets_[i + 1]; ++k)
      for (std::size_t j = 0; j < axes_.size(); ++j)
        slope[axes_[j]] += weights_[k][j] * field[Layout::scalar(patch_[k])];
    return slope;
  }

 private:
  /// A component of the field at entry k of the patches; at mirror images that of the mirrored vector.
  template <class Layout>
  double at_image(std::size_t k, int c, const std::vector<double>& field) const {
    if (turn_.empty() || turn_[k] == 0) return field[Layout::vector(patch_[k], c)];
    const Mat3<double>& turn = turns_[static_cast<std::size_t>(turn_[k])];
    double value = 0;
    for (std::size_t b = 0; b < axes_.size(); ++b)
      value += turn(axes_[c], axes_[b]) * field[Layout::vector(patch_[k], static_cast<int>(b))];
    return value;
  }

  std::vector<int> at_;
  std::vector<int> axes_;
  bool axisymmetric_;
  std::vector<double> radius_;                  ///< mm, per entry; of bodies of revolution
  std::vector<std::size_t> offsets_{0};         ///< per entry, into the patches
  std::vector<int> patch_;                      ///< nodes
  std::vector<std::array<double, 3>> weights_;  ///< 1/mm, per node of a patch and coordinate
  std::vector<Mat3<double>> error_directions_;  ///< per entry
  std::vector<int> turn_;                       ///< per node of a patch, in turns_; empty: none is a mirror image
  std::vector<Mat3<double>> turns_;             ///< of vectors to those of mirror images, the identity first
  std::size_t fallbacks_ = 0;
  std::optional<FarNodes> far_;  ///< none: all nodes of the patches are here
};

}  // namespace fsi
