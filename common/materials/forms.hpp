#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <variant>

namespace fsi {

/// A list of types.
template <class... Law>
struct Laws {
  using variant = std::variant<Law...>;
  static constexpr std::size_t count = sizeof...(Law);
};

/// The forms in which element loops take a law of this type: itself, unless its file specialises this.
///   type             the list of forms
///   decides(name)    whether a parameter decides which of them holds
///   of(law, varies)  the form for the law's constants; varies: whether such a parameter varies from point to point
template <class Law, class = void>
struct FormsOf {
  using type = Laws<Law>;
  static bool decides(const std::string&) { return false; }
  static std::variant<Law> of(const Law& law, bool) { return law; }
};

namespace detail {

/// A list with one more type, unless it has it.
template <class List, class Law>
struct WithLaw;
template <class... Law, class New>
struct WithLaw<Laws<Law...>, New> {
  using type = std::conditional_t<(std::is_same_v<Law, New> || ...), Laws<Law...>, Laws<Law..., New>>;
};

/// Both lists one after the other, each type once.
template <class List, class Others>
struct Joined;
template <class List>
struct Joined<List, Laws<>> {
  using type = List;
};
template <class List, class First, class... Rest>
struct Joined<List, Laws<First, Rest...>> {
  using type = typename Joined<typename WithLaw<List, First>::type, Laws<Rest...>>::type;
};

/// A list with the forms of all laws of a variant.
template <class List, class Variant>
struct FormsOfAll;
template <class List>
struct FormsOfAll<List, std::variant<>> {
  using type = List;
};
template <class List, class First, class... Rest>
struct FormsOfAll<List, std::variant<First, Rest...>> {
  using type =
      typename FormsOfAll<typename Joined<List, typename FormsOf<First>::type>::type, std::variant<Rest...>>::type;
};

/// A list with those of the others that have element loops of their own.
template <class List, class Others>
struct OwnLoops;
template <class List>
struct OwnLoops<List, Laws<>> {
  using type = List;
};
template <class List, class First, class... Rest>
struct OwnLoops<List, Laws<First, Rest...>> {
  using next = std::conditional_t<First::has_own_loops, typename WithLaw<List, First>::type, List>;
  using type = typename OwnLoops<next, Laws<Rest...>>::type;
};

template <class Law, class Variant>
struct IndexOfLaw;
template <class Law, class... Others>
struct IndexOfLaw<Law, std::variant<Others...>> {
  static constexpr std::size_t get() {
    constexpr bool same[] = {std::is_same_v<Law, Others>...};
    for (std::size_t i = 0; i < sizeof...(Others); ++i)
      if (same[i]) return i;
    return sizeof...(Others);
  }
};

}  // namespace detail

/// The place of a type in a variant, counted from zero.
template <class Law, class Variant>
inline constexpr std::size_t index_of_law = detail::IndexOfLaw<Law, Variant>::get();

}  // namespace fsi
