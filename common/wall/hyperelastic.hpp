#pragma once

#include <type_traits>

#include "fem/contributions.hpp"
#include "materials/compressible_law.hpp"
#include "materials/dispersed_artery.hpp"
#include "materials/strain.hpp"

namespace fsi {

/// Hyperelastic wall in mixed displacement-pressure form, PSPG-stabilised (docs/theory.md, section 4). With
/// F = I + grad d, J = det F, acceleration a and test functions v and q the residual is
///   (rho a, v) + (P' - p G, grad v)
///   - (g, q) - (p / kappa, q) - sum over elements (tau J F^-T grad p, F^-T grad q),
///   tau = alpha h^2 / (2 (mu + rho c_w^2)),
/// P' = F S', g = J - 1 and G = dg/dF = J F^-T for the nearly incompressible laws; CompressibleLaw has its own.
/// c_w, the speed of pressure waves in the scene, is zero where it is not known. With c_w the share of the wall's
/// inertia that the stabilisation takes, tau rho / t^2 with t = h / c_w, is below alpha / 2 however soft the layer. The
/// stabilisation's residual is without inertia, which would destabilise small steps. Elements without a size
/// (Taylor-Hood) get no stabilisation. Fibre directions vary from point to point, also where gradients are constant.
template <class Material>
struct Hyperelastic {
  double density;        ///< mg/mm^3; 0 in statics
  double bulk_modulus;   ///< kappa of the layer, kPa
  double stabilisation;  ///< alpha
  Material material;
  double wave_speed = 0;  ///< c_w, mm/ms

  using FibreData = typename Material::FibreData;
  static constexpr bool has_fibres = std::is_same_v<FibreData, Fibres>;
  static constexpr bool is_compressible = std::is_same_v<Material, CompressibleLaw>;
  static constexpr bool varies = false;  ///< see wall/varying_hyperelastic.hpp

  /// What the isochoric stress is computed from at a point: nothing more where there are no fibres, since it is a
  /// function of gradients alone.
  template <class T>
  struct Isotropic {
    Mat3<T> isochoric_flux;  ///< P'
  };
  template <class T>
  struct Anisotropic {
    Mat3<T> gradient;  ///< F
    Strain<T> strain;
  };
  template <class T>
  struct Prepared : std::conditional_t<has_fibres, Anisotropic<T>, Isotropic<T>> {
    Mat3<T> volume_gradient;     ///< G
    T volume_change;             ///< g
    T volume_ratio;              ///< J; 1 where forces balance on the reference configuration
    Vec3<T> stabilisation_flux;  ///< -tau J F^-1 F^-T grad p; not set for elements without stabilisation
  };

  /// \param size_squared  h^2 of the reference element, mm^2, a Pack, or Unstabilised
  template <class T, class Size>
  Prepared<T> prepare(const Mat3<T>& grad_d, const Vec3<T>& grad_p, const Size& size_squared) const {
    const Deformation<T> f = deformation(grad_d);
    Prepared<T> k;
    if constexpr (is_compressible) {
      const Response<T> response = material.response(grad_d, f);
      k.isochoric_flux = response.flux;
      k.volume_gradient = response.volume_gradient;
      k.volume_change = response.volume_measure;
      k.volume_ratio = response.volume_ratio;
    } else {
      k.volume_gradient = f.cofactor_gradient;
      k.volume_change = f.volume_change;
      k.volume_ratio = f.volume_ratio;
      if constexpr (has_fibres) {
        k.gradient = f.gradient;
        k.strain = strain_of(grad_d, f);
      } else {
        k.isochoric_flux = isochoric_flux(f, strain_of(grad_d, f), {});
      }
    }
    if constexpr (!std::is_same_v<Size, Unstabilised>)
      k.stabilisation_flux = stabilisation_flux(f, grad_p, size_squared);
    return k;
  }

  /// F S', kPa.
  template <class T>
  Mat3<T> isochoric_flux(const Deformation<T>& f, const Strain<T>& strain, const FibreData& fibres) const {
    return f.gradient * material.stress(strain, fibres);
  }
  template <class T>
  Vec3<T> stabilisation_flux(const Deformation<T>& f, const Vec3<T>& grad_p, Pack size_squared) const {
    const Pack tau =
        Pack(stabilisation / (2 * (material.shear_modulus() + density * wave_speed * wave_speed))) * size_squared;
    if constexpr (is_compressible)
      if (material.on_reference()) return -tau * grad_p;
    const T scale = -tau / f.volume_ratio;
    return scale * transposed_times(f.cofactor_gradient, f.cofactor_gradient * grad_p);
  }

  /// \param acceleration  mm/ms^2
  /// \param pressure      kPa
  /// \param fibres    at the point
  template <class T, class A, class P>
  Integrand<A, Sum<T, P>, Sum<T, P>> integrand(const Prepared<T>& k, const Vec3<A>& acceleration, const P& pressure,
                                               const FibreData& fibres) const {
    Integrand<A, Sum<T, P>, Sum<T, P>> f;
    f.source = Pack(density) * acceleration;
    if constexpr (has_fibres) {
      f.flux = k.gradient * material.stress(k.strain, fibres) - pressure * k.volume_gradient;
    } else {
      f.flux = k.isochoric_flux - pressure * k.volume_gradient;
    }
    f.scalar_source = -k.volume_change - Pack(1.0 / bulk_modulus) * pressure;
    for (int i = 0; i < 3; ++i) f.scalar_flux[i] = k.stabilisation_flux[i];
    return f;
  }
};

}  // namespace fsi
