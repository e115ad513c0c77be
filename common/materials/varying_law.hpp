#pragma once

#include "materials/material.hpp"

namespace fsi {

/// What the element loops know of a layer's law at one place: its constants, those that the law does not have being zero.
template <class Constant>
struct LawConstants {
  Constant c10 = 0;           ///< kPa; of the compressible laws mu
  Constant c01 = 0;           ///< kPa
  Constant k1 = 0;            ///< kPa, with the factor on the fibres' energy
  Constant k2 = 0;            ///< -
  Constant kappa = 0;         ///< -
  Constant bulk_modulus = 0;  ///< kPa
  Constant viscosity = 0;     ///< eta of wall/kelvin_voigt.hpp, kPa ms

  /// mu of the undeformed isotropic part, kPa
  Constant shear_modulus() const { return c10 + c01; }
};

/// Of a material. \param of_structure  kappa where the law has none of its own, kPa
LawConstants<double> law_constants(const Material& material, double of_structure);

/// A law at one place.
struct LawHere {
  LawConstants<double> constants;
  double fibre_angle = 0;  ///< radians from the circumference; of laws with fibres
};

/// The constants at a point of every lane, and the fibres there.
struct PointConstants : LawConstants<Pack> {
  Fibres fibres;  ///< of laws that have them

  /// Those of one place, in one lane.
  void set(int lane, const LawConstants<double>& from);
};

/// Any law with constants that vary from point to point: one type for all laws, so that the loops over such layers are
/// compiled once. A layer has one of them. Layers whose constants are constant do not know of it.
struct VaryingLaw {
  enum class Kind { neo_hookean, mooney_rivlin, artery, dispersed_artery, compressible };
  using FibreData = PointConstants;
  Kind kind = Kind::neo_hookean;
  CompressibleLaw::Kind compressible = CompressibleLaw::Kind::saint_venant_kirchhoff;

  bool is_compressible() const { return kind == Kind::compressible; }
  /// Forces balance on the reference configuration.
  bool on_reference() const { return is_compressible() && compressible == CompressibleLaw::Kind::linear; }

  /// S' of the nearly incompressible ones, kPa.
  template <class T>
  Sym3<T> stress(const Strain<T>& s, const PointConstants& at) const {
    if (kind == Kind::mooney_rivlin) return MooneyRivlinOf<Pack>{at.c10, at.c01}.stress(s, {});
    if (kind == Kind::artery) return artery(at).stress(s, at.fibres);
    if (kind == Kind::dispersed_artery) return DispersedArteryOf<Pack>{artery(at)}.stress(s, at.fibres);
    return NeoHookeanOf<Pack>{at.c10, 0.0, 0.0}.stress(s, {});
  }

  /// What it answers to a deformation.
  /// \param h  grad d
  /// \param f  deformation(h)
  template <class T>
  Response<T> response(const Mat3<T>& h, const Deformation<T>& f, const PointConstants& at) const {
    if (is_compressible()) return CompressibleLaw::response_of(compressible, at.c10, h, f);
    return {f.gradient * stress(strain_of(h, f), at), f.volume_change, f.cofactor_gradient, f.volume_ratio};
  }
  /// The measure g of the change of volume and G = dg/dF, which no constant enters; the flux is not set.
  template <class T>
  Response<T> response(const Mat3<T>& h, const Deformation<T>& f) const {
    if (is_compressible()) return CompressibleLaw::response_of(compressible, Pack(0.0), h, f);
    return {{}, f.volume_change, f.cofactor_gradient, f.volume_ratio};
  }

  /// Psi', kPa.
  template <class T>
  T energy(const Mat3<T>& h, const PointConstants& at) const {
    if (is_compressible()) return CompressibleLaw::energy_of(compressible, at.c10, h);
    const Strain<T> s = strain_of(h);
    if (kind == Kind::mooney_rivlin) return MooneyRivlinOf<Pack>{at.c10, at.c01}.energy(s, {});
    if (kind == Kind::artery) return artery(at).energy(s, at.fibres);
    if (kind == Kind::dispersed_artery) return DispersedArteryOf<Pack>{artery(at)}.energy(s, at.fibres);
    return NeoHookeanOf<Pack>{at.c10, 0.0, 0.0}.energy(s, {});
  }

 private:
  static ArteryOf<Pack> artery(const PointConstants& at) { return {at.c10, at.k1, at.k2, 1.0, 0.0, at.kappa}; }
};

/// The law of a layer of this material. \param dispersed  whether fibres are dispersed somewhere
VaryingLaw varying_law(const Material& material, bool dispersed);

}  // namespace fsi
