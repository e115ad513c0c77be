#pragma once

#include <type_traits>

#include "wall/hyperelastic.hpp"

namespace fsi {

/// The shape that a wall has without load, found from the one that it has under load, which is the mesh ([Govindjee1996];
/// docs/theory.md, section 4.6). The unknown d leads from the unloaded position X to the mesh's, x = X + d. With
///   G = dX/dx = I - grad_x d,   F = G^-1,   J = det F,   grad_X d = F - I = (grad_x d) F
/// the integrals over the unloaded wall are those over the mesh of
///   (1/J) P F^T : grad_x v,   (1/J) s q,   (1/J) F f . grad_x q
/// with flux P, source s and stabilising flux f of the forward problem, evaluated with grad_X d and grad_X p =
/// F^T grad_x p: so it has the very solution of the forward problem on the unloaded mesh. The size in the stabilisation is
/// that of the element as it is on the mesh, in both.
template <class Material>
struct UnloadedShape {
  Hyperelastic<Material> forward;

  using FibreData = typename Hyperelastic<Material>::FibreData;

  template <class T>
  struct Prepared {
    typename Hyperelastic<Material>::template Prepared<T> forward;
    Mat3<T> gradient;  ///< F
    T inverse_ratio;   ///< 1/J
    T volume_ratio;    ///< det G: positive while elements are not inverted
  };

  /// \param grad_d, grad_p  on the mesh
  template <class T, class Size>
  Prepared<T> prepare(const Mat3<T>& grad_d, const Vec3<T>& grad_p, const Size& size_squared) const {
    const Deformation<T> back = deformation(-1.0 * grad_d);
    Prepared<T> k;
    k.inverse_ratio = k.volume_ratio = back.volume_ratio;
    const T ratio = Pack(1.0) / back.volume_ratio;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) k.gradient(i, j) = ratio * back.cofactor_gradient(j, i);
    if constexpr (std::is_same_v<Size, Unstabilised>) {
      k.forward = forward.prepare(grad_d * k.gradient, grad_p, size_squared);
    } else {
      k.forward = forward.prepare(grad_d * k.gradient, transposed_times(k.gradient, grad_p), size_squared);
    }
    return k;
  }

  template <class T, class A, class P>
  Integrand<Product<T, A>, Sum<T, P>, Sum<T, P>> integrand(const Prepared<T>& k, const Vec3<A>& acceleration,
                                                           const P& pressure, const FibreData& fibres) const {
    const auto at = forward.integrand(k.forward, acceleration, pressure, fibres);
    Integrand<Product<T, A>, Sum<T, P>, Sum<T, P>> f;
    f.source = k.inverse_ratio * at.source;
    f.flux = k.inverse_ratio * times_transposed(at.flux, k.gradient);
    f.scalar_source = k.inverse_ratio * at.scalar_source;
    f.scalar_flux = k.inverse_ratio * (k.gradient * at.scalar_flux);
    return f;
  }
};

}  // namespace fsi
