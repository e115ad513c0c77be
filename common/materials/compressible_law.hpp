#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <string>
#include <type_traits>
#include <variant>

#include "materials/forms.hpp"
#include "materials/law_list.hpp"

namespace fsi {

/// Whether a law measures its change of volume otherwise than by J - 1: such laws have no FibreData.
template <class Law, class = void>
struct IsCompressible : std::true_type {};
template <class Law>
struct IsCompressible<Law, std::void_t<typename Law::FibreData>> : std::false_type {};

/// Any law that does not measure its change of volume by J - 1, as the element loops see it: one type for all, so that
/// the loops are compiled once. Choosing the law at each point costs nothing beside its arithmetic.
template <class Constant>
struct CompressibleLawOf {
  using FibreData = NoFibres;
  std::size_t kind = index_of_law<SaintVenantKirchhoff, Material>;  ///< place in Material
  Constant mu = 0;                                                  ///< kPa; the bulk modulus is the form's

  template <class Other>
  using with = CompressibleLawOf<Other>;
  static constexpr bool has_own_loops = true;
  static constexpr auto constants() { return std::array{&CompressibleLawOf::mu}; }

  template <class Law>
  bool is() const {
    return kind == index_of_law<Law, Material>;
  }
  Constant shear_modulus() const { return mu; }
  /// Whether forces balance on the reference configuration.
  bool on_reference() const {
    return of_kind(kind, [](auto law) { return decltype(law)::type::on_reference; });
  }

  /// \param h  grad d
  /// \param f  deformation(h)
  template <class T>
  Response<T> response(const Mat3<T>& h, const Deformation<T>& f) const {
    return of_kind(kind, [&](auto law) { return decltype(law)::type::response(mu, h, f); });
  }

  /// Psi', kPa
  template <class T>
  T energy(const Mat3<T>& h) const {
    return of_kind(kind, [&](auto law) { return decltype(law)::type::energy(mu, h); });
  }

 private:
  template <class Law>
  struct Tag {
    using type = Law;
  };
  /// visit(Tag<Law>{}) for the law at this place in Material.
  template <std::size_t i = 0, class Visit>
  static auto of_kind(std::size_t kind, const Visit& visit) {
    using Law = std::variant_alternative_t<i, Material>;
    if constexpr (!IsCompressible<Law>::value) {
      return of_kind<i + 1>(kind, visit);
    } else if constexpr (i == last()) {
      assert(kind == i);
      return visit(Tag<Law>{});
    } else {
      if (kind == i) return visit(Tag<Law>{});
      return of_kind<i + 1>(kind, visit);
    }
  }
  /// The place of Material's last such law.
  template <std::size_t i = std::variant_size_v<Material> - 1>
  static constexpr std::size_t last() {
    if constexpr (IsCompressible<std::variant_alternative_t<i, Material>>::value)
      return i;
    else
      return last<i - 1>();
  }
};
using CompressibleLaw = CompressibleLawOf<double>;

template <class Law>
struct FormsOf<Law, std::enable_if_t<IsCompressible<Law>::value>> {
  using type = Laws<CompressibleLaw>;
  static bool decides(const std::string&) { return false; }
  static std::variant<CompressibleLaw> of(const Law& law, bool) {
    return CompressibleLaw{index_of_law<Law, Material>, law.shear_modulus()};
  }
};

}  // namespace fsi
