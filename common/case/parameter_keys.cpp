#include "case/parameter_keys.hpp"

namespace fsi {

std::string about(const Parameter& parameter) {
  const std::string unit = parameter.quantity->unit;
  return parameter.about + (unit.empty() ? "" : (parameter.about.empty() ? "in " : " in ") + unit) +
         (parameter.required || parameter.of_a_set ? "" : ", default " + text_for_people(parameter.standard));
}

}  // namespace fsi
