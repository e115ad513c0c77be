#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <vector>

#include "materials/varying_law.hpp"
#include "wall/hyperelastic.hpp"
#include "wall/unloaded_shape.hpp"

namespace fsi {

/// The same form where the constants of its law vary: they are looked up at each point, with the bulk modulus. The
/// stabilisation takes mu of the element, the mean over its points (docs/theory.md, section 4.8).
template <>
struct Hyperelastic<VaryingLaw> {
  double density;        ///< mg/mm^3; 0 in statics
  double bulk_modulus;   ///< kPa, at the layer's mean constants; the points have their own
  double stabilisation;  ///< alpha
  VaryingLaw material;
  double wave_speed = 0;    ///< c_w, mm/ms
  Pack shear_modulus{0.0};  ///< mu of the pack's elements, kPa: set by in_pack()

  using FibreData = PointConstants;
  static constexpr bool has_fibres = true, is_compressible = true, varies = true;

  template <class T>
  struct Prepared {
    Mat3<T> gradient;              ///< grad d
    Deformation<T> deformation;    ///< of it
    Strain<T> strain;              ///< not set for compressible laws
    T volume_ratio;                ///< J; 1 where forces balance on the reference configuration
    Vec3<T> stabilisation_flux{};  ///< not set for elements without stabilisation
  };

  template <class T, class Size>
  Prepared<T> prepare(const Mat3<T>& grad_d, const Vec3<T>& grad_p, const Size& size_squared) const {
    Prepared<T> k;
    k.gradient = grad_d;
    k.deformation = deformation(grad_d);
    if (!material.is_compressible()) k.strain = strain_of(grad_d, k.deformation);
    k.volume_ratio = material.on_reference() ? T(1.0) : k.deformation.volume_ratio;
    if constexpr (!std::is_same_v<Size, Unstabilised>)
      k.stabilisation_flux = stabilisation_flux(k.deformation, grad_p, size_squared);
    return k;
  }

  template <class T>
  Vec3<T> stabilisation_flux(const Deformation<T>& f, const Vec3<T>& grad_p, Pack size_squared) const {
    const Pack tau = Pack(stabilisation / 2) / (shear_modulus + Pack(density * wave_speed * wave_speed)) * size_squared;
    if (material.on_reference()) return -tau * grad_p;
    const T scale = -tau / f.volume_ratio;
    return scale * transposed_times(f.cofactor_gradient, f.cofactor_gradient * grad_p);
  }

  template <class T, class A, class P>
  Integrand<A, Sum<T, P>, Sum<T, P>> integrand(const Prepared<T>& k, const Vec3<A>& acceleration, const P& pressure,
                                               const PointConstants& at) const {
    Integrand<A, Sum<T, P>, Sum<T, P>> f;
    f.source = Pack(density) * acceleration;
    if (material.is_compressible()) {
      const Response<T> response = material.response(k.gradient, k.deformation, at);
      f.flux = response.flux - pressure * response.volume_gradient;
      f.scalar_source = -response.volume_measure;
    } else {
      f.flux = k.deformation.gradient * material.stress(k.strain, at) - pressure * k.deformation.cofactor_gradient;
      f.scalar_source = -k.deformation.volume_change;
    }
    f.scalar_source -= (Pack(1.0) / at.bulk_modulus) * pressure;
    for (int i = 0; i < 3; ++i) f.scalar_flux[i] = k.stabilisation_flux[i];
    return f;
  }
};

/// The form as the elements of a pack see it: with mu of theirs where constants vary, itself where they do not.
/// \param points  what varies from point to point, of all packs; or null
template <class Form, class Points>
const Form& in_pack(const Form& form, const Points&, std::size_t) {
  return form;
}
template <std::size_t count>
Hyperelastic<VaryingLaw> in_pack(const Hyperelastic<VaryingLaw>& form,
                                 const std::vector<std::array<PointConstants, count>>* points, std::size_t index) {
  assert(points);
  Hyperelastic<VaryingLaw> here = form;
  here.shear_modulus = Pack(0.0);
  for (const auto& at : (*points)[index]) here.shear_modulus += at.shear_modulus;
  here.shear_modulus *= Pack(1.0 / count);
  return here;
}
template <std::size_t count>
UnloadedShape<VaryingLaw> in_pack(const UnloadedShape<VaryingLaw>& form,
                                  const std::vector<std::array<PointConstants, count>>* points, std::size_t index) {
  return {in_pack(form.forward, points, index)};
}

}  // namespace fsi
