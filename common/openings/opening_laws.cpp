#include "openings/opening_laws.hpp"

#include <type_traits>

#include "materials/law_parameters.hpp"
#include "openings/four_element_windkessel.hpp"
#include "openings/resistance.hpp"
#include "openings/windkessel.hpp"

namespace fsi {

namespace {

template <class Law, class = void>
struct Section {
  static constexpr const char* about = "";
};
template <class Law>
struct Section<Law, std::void_t<decltype(Law::about)>> {
  static constexpr const char* about = Law::about;
};

template <class Law, class = void>
struct Letters {
  static decltype(OpeningLawKind::letters) get() { return {}; }
};
template <class Law>
struct Letters<Law, std::void_t<decltype(Law::letters())>> {
  static decltype(OpeningLawKind::letters) get() { return Law::letters(); }
};

template <class Law>
std::shared_ptr<const OpeningLaw> make(const ParameterValues& values) {
  return std::make_shared<const Law>(with_parameters<Law>(values));
}

template <class... Laws>
NameTable<OpeningLawKind> table_of() {
  return {"law of an opening",
          {{Laws::name,
            OpeningLawKind{Section<Laws>::about, parameters_of_law<Laws>(), Letters<Laws>::get(), make<Laws>}}...}};
}

}  // namespace

const NameTable<OpeningLawKind>& opening_laws() {
  static const auto table = table_of<Resistance, Windkessel, FourElementWindkessel>();
  return table;
}

}  // namespace fsi
