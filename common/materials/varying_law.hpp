#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "materials/compressible_law.hpp"
#include "materials/forms.hpp"
#include "materials/law_list.hpp"

namespace fsi {

/// All forms in which the element loops take the laws of Material.
using LawForms = typename detail::FormsOfAll<Laws<>, Material>::type;

namespace detail {
template <class... Form>
constexpr std::size_t most_constants(const Laws<Form...>&) {
  return std::max({Form::constants().size()...});
}
}  // namespace detail

/// The constants of a layer's law at one place, as the element loops take them.
template <class Constant>
struct LawConstants {
  /// Those of its energy and stress, in the order of its constants(); laws with fewer do not use the rest.
  std::array<Constant, detail::most_constants(LawForms{})> of_law{};
  Constant shear_modulus{};  ///< mu of the undeformed isotropic part, kPa
  Constant bulk_modulus{};   ///< kPa
  Constant viscosity{};      ///< eta of wall/kelvin_voigt.hpp, kPa ms
};

/// The constants of a material, with viscosity 0. \param of_structure  kappa where the law has none of its own, kPa
LawConstants<double> law_constants(const Material& material, double of_structure);

/// A law at one place.
struct LawHere {
  LawConstants<double> constants;
  double fibre_angle = 0;  ///< radians from the circumference; of laws with fibres
};

/// The constants at a point of every lane, and the fibres there.
struct PointConstants : LawConstants<Pack> {
  Fibres fibres;  ///< of laws that have them

  /// Sets one lane to the constants of one place.
  void set(int lane, const LawConstants<double>& from);
};

/// Any law with constants that vary from point to point: one type for all laws, so that the loops over such layers are
/// compiled once. Layers with one set of constants take it, too, where their law has no loops of its own.
class VaryingLaw {
 public:
  using FibreData = PointConstants;
  static constexpr bool has_own_loops = true;

  VaryingLaw() = default;
  /// \param varies  whether a parameter that decides the law's form varies, see FormsOf
  VaryingLaw(const Material& material, bool varies);

  bool is_compressible() const { return form_ == index_of_law<CompressibleLaw, LawForms::variant>; }
  /// Whether forces balance on the reference configuration.
  bool on_reference() const { return is_compressible() && CompressibleLaw{kind_, 0}.on_reference(); }

  /// S' of a law that is not compressible, kPa.
  template <class T>
  Sym3<T> stress(const Strain<T>& s, const PointConstants& at) const {
    return incompressible<0, Sym3<T>>(at, [&](const auto& law, const auto& fibres) { return law.stress(s, fibres); });
  }

  /// The law's response to a deformation.
  /// \param h  grad d
  /// \param f  deformation(h)
  template <class T>
  Response<T> response(const Mat3<T>& h, const Deformation<T>& f, const PointConstants& at) const {
    if (is_compressible()) return compressible(at.of_law[0]).response(h, f);
    return {f.gradient * stress(strain_of(h, f), at), f.volume_change, f.cofactor_gradient, f.volume_ratio};
  }
  /// The measure g of the change of volume and G = dg/dF, which depend on no constant; the flux is meaningless.
  template <class T>
  Response<T> response(const Mat3<T>& h, const Deformation<T>& f) const {
    if (is_compressible()) return compressible(Pack(0.0)).response(h, f);
    return {{}, f.volume_change, f.cofactor_gradient, f.volume_ratio};
  }

  /// Psi', kPa.
  template <class T>
  T energy(const Mat3<T>& h, const PointConstants& at) const {
    if (is_compressible()) return compressible(at.of_law[0]).energy(h);
    const Strain<T> s = strain_of(h);
    return incompressible<0, T>(at, [&](const auto& law, const auto& fibres) { return law.energy(s, fibres); });
  }

 private:
  CompressibleLawOf<Pack> compressible(const Pack& mu) const { return {kind_, mu}; }

  template <class Form, std::size_t... i>
  static Form with_constants(const PointConstants& at, std::index_sequence<i...>) {
    constexpr auto members = Form::constants();
    Form law{};
    ((law.*std::get<i>(members) = at.of_law[i]), ...);
    return law;
  }

  /// visit(law, fibres) of this law at a point.
  template <std::size_t i, class Result, class Visit>
  Result incompressible(const PointConstants& at, const Visit& visit) const {
    using Form = std::variant_alternative_t<i, LawForms::variant>;
    if constexpr (std::is_same_v<Form, CompressibleLaw>) {
      return incompressible<i + 1, Result>(at, visit);
    } else {
      if (i + 1 < LawForms::count && form_ != i) {
        if constexpr (i + 1 < LawForms::count) return incompressible<i + 1, Result>(at, visit);
      }
      assert(form_ == i);
      using Here = typename Form::template with<Pack>;
      const auto law = with_constants<Here>(at, std::make_index_sequence<Here::constants().size()>());
      if constexpr (std::is_same_v<typename Form::FibreData, Fibres>)
        return visit(law, at.fibres);
      else
        return visit(law, NoFibres{});
    }
  }

  std::size_t form_ = 0, kind_ = 0;  // places in LawForms and, for compressible laws, in Material
};

/// A layer's law as the element loops see it: the forms with loops of their own, and VaryingLaw for any other.
using ElementLaw =
    typename detail::WithLaw<typename detail::OwnLoops<Laws<>, LawForms>::type, VaryingLaw>::type::variant;
ElementLaw element_law(const Material& material);

/// Whether a parameter decides which form a material has.
bool decides_form(const Material& material, const std::string& parameter);

}  // namespace fsi
