#include "network/element_kinds.hpp"

#include <type_traits>
#include <utility>

#include "materials/law_parameters.hpp"
#include "network/capacitor.hpp"
#include "network/chamber.hpp"
#include "network/elastance.hpp"
#include "network/inductor.hpp"
#include "network/resistor.hpp"
#include "network/sources.hpp"
#include "network/valve.hpp"

namespace fsi {

namespace {

template <class E, class = void>
struct HasCourse : std::false_type {};
template <class E>
struct HasCourse<E, std::void_t<decltype(&E::course)>> : std::true_type {};

template <class E>
std::shared_ptr<const NetworkElement> make_element(const ParameterValues& values,
                                                   [[maybe_unused]] const std::function<double(double)>& course) {
  E element = with_parameters<E>(values);
  if constexpr (HasCourse<E>::value) element.course = course;
  return std::make_shared<const E>(std::move(element));
}

template <class E>
NameTable<NetworkElementKind>::Row row(ElementCourse course = ElementCourse::none) {
  return {E::name, {parameters_of_law<E>(), course, make_element<E>}};
}

}  // namespace

const NameTable<NetworkElementKind>& network_element_kinds() {
  static const NameTable<NetworkElementKind> table{
      "kind of a network's element",
      {row<Resistor>(), row<Capacitor>(), row<Inductor>(), row<Diode>(), row<Valve>(), row<Chamber>(),
       row<Elastance>(ElementCourse::elastance), row<PressureSource>(ElementCourse::pressure),
       row<FlowSource>(ElementCourse::flow)}};
  return table;
}

}  // namespace fsi
