#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "fem/contributions.hpp"
#include "fem/element_packs.hpp"
#include "fem/nodal_frames.hpp"
#include "fluid/fluid_input.hpp"
#include "math/kinematics.hpp"
#include "mesh/submesh.hpp"

namespace fsi {

/// The pressure gradient F^-T grad p, which jumps between elements, as a continuous field: projected in L2 with a lumped
/// mass matrix,
///   pi_a (J, N_a) = (J F^-T grad p, N_a),
/// of the level that a step's rates refer to. It is found anew whenever that level is another one. Components that
/// change their sign in a mirror vanish on it, as those of the whole body do.
template <class Element>
class PressureProjection {
 public:
  static constexpr int n = Element::components;

  /// \param mirrored  components that vanish: normal to planes of symmetry, radial on an axis
  explicit PressureProjection(VanishingComponents<n> mirrored) : mirrored_(std::move(mirrored)) {}

  /// Of in.fluid_reference on the domain of in.mesh_reference: vectors per fluid node in the vector layout, kPa/mm.
  /// Processes that share the fluid out ask for it together.
  const std::vector<double>& of(const FluidInput& in, const ElementPacks<Element>& packs, const PartNodes& fluid) {
    const int nodes = fluid.node_count();
    const bool kept = same(flow_, in.fluid_reference) && same(mesh_, in.mesh ? in.mesh_reference : nullptr);
    if (fluid.processes().any(!kept || gradient_.empty())) {
      flow_.assign(in.fluid_reference, in.fluid_reference + static_cast<std::size_t>(nodes) * Mixed::entries);
      mesh_.clear();
      if (in.mesh) mesh_.assign(in.mesh_reference, in.mesh_reference + static_cast<std::size_t>(nodes) * n);
      project(packs, nodes);
      if (fluid.share) fluid.share->template update<Vector>(gradient_);
    }
    return gradient_;
  }

 private:
  using Mixed = MixedLayout<n>;
  using Vector = VectorLayout<n>;

  static bool same(const std::vector<double>& kept, const double* given) {
    return given ? !kept.empty() && std::equal(kept.begin(), kept.end(), given) : kept.empty();
  }

  void project(const ElementPacks<Element>& packs, int nodes) {
    // Rows as of a residual: the vector's hold the integrals of the gradient, the scalar's the lumped mass.
    std::vector<double> sums(flow_.size(), 0.0);
    for_each_thread(packs, serial_residual_elements, [&](int, const auto& mine) {
      NodalVector<Element> d{};
      NodalScalar<Element> p{};
      ElementRows<Element, Pack> rows;
      for (const auto& pack : mine) {
        gather<Mixed>(p, pack, flow_.data());
        if (!mesh_.empty()) gather<Vector>(d, pack, mesh_.data());
        integrate(
            rows, pack.geometry,
            [&](const auto& g) {
              const auto f = deformation(gradient_of(d, g));
              Integrand<Pack> k{};
              k.source = f.cofactor_gradient * gradient_of(p, g);
              k.scalar_source = f.volume_ratio;
              return k;
            },
            [](const Integrand<Pack>& k, const auto&, int) { return k; });
        scatter_residual<Element>(rows, pack, sums.data());
      }
    });
    gradient_.resize(static_cast<std::size_t>(nodes) * n);
    for (int a = 0; a < nodes; ++a)
      for (int k = 0; k < n; ++k) gradient_[Vector::vector(a, k)] = sums[Mixed::vector(a, k)] / sums[Mixed::scalar(a)];
    mirrored_.clear(gradient_);
  }

  VanishingComponents<n> mirrored_;
  std::vector<double> flow_, mesh_;  ///< of the level that the gradient belongs to
  std::vector<double> gradient_;
};

}  // namespace fsi
