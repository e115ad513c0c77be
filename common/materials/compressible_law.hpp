#pragma once

#include "materials/compressible_neo_hookean.hpp"
#include "materials/linear_elastic.hpp"
#include "materials/saint_venant_kirchhoff.hpp"

namespace fsi {

/// The laws whose change of volume is not measured by J - 1, as the element loops see them: one type for all, so that
/// the loops are compiled once for the three. A layer has one of them; choosing it at each point costs nothing beside
/// its arithmetic.
struct CompressibleLaw {
  enum class Kind { saint_venant_kirchhoff, linear, neo_hookean };
  using FibreData = NoFibres;
  Kind kind = Kind::saint_venant_kirchhoff;
  double mu = 0;  ///< kPa; the bulk modulus is the form's

  double shear_modulus() const { return mu; }
  /// Forces balance on the reference configuration.
  bool on_reference() const { return kind == Kind::linear; }

  /// \param h  grad d
  /// \param f  deformation(h)
  template <class T>
  Response<T> response(const Mat3<T>& h, const Deformation<T>& f) const {
    return response_of(kind, mu, h, f);
  }

  /// Psi', kPa
  template <class T>
  T energy(const Mat3<T>& h) const {
    return energy_of(kind, mu, h);
  }

  /// The same with a constant that may differ from lane to lane.
  template <class T, class Constant>
  static Response<T> response_of(Kind kind, const Constant& mu, const Mat3<T>& h, const Deformation<T>& f) {
    if (kind == Kind::linear) return LinearElastic::response(mu, h);
    if (kind == Kind::neo_hookean) return CompressibleNeoHookean::response(mu, h, f);
    return SaintVenantKirchhoff::response(mu, h, f);
  }
  template <class T, class Constant>
  static T energy_of(Kind kind, const Constant& mu, const Mat3<T>& h) {
    if (kind == Kind::linear) return LinearElastic::energy(mu, h);
    if (kind == Kind::neo_hookean) return CompressibleNeoHookean::energy(mu, h);
    return SaintVenantKirchhoff::energy(mu, h);
  }
};

}  // namespace fsi
