#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/quantity.hpp"

namespace fsi {

/// The parameters of one wall layer by name, as its case file states them. What is absent has its default.
using ParameterValues = std::map<std::string, double>;

/// Sets of parameters of which a layer gives exactly one, as Young's modulus with Poisson's ratio or Lame's constants.
using ParameterSets = std::vector<std::vector<std::string>>;

/// A parameter of a material as users see it: a key of [structure.layers.NAME].
struct Parameter {
  std::string name;
  std::string about;  ///< meaning, without the unit
  const Quantity* quantity;
  Bounds bounds;
  bool required;
  double standard = 0;    ///< the value where it is absent and not required
  bool of_a_set = false;  ///< of one of the kind's ParameterSets: absent where another is given, without default
};

/// The same beside a law, with the member that holds it. A member's initial value is its default.
template <class Law>
struct ParameterOf {
  double Law::*member;
  const char* name;
  const char* about;
  const Quantity& quantity;
  Bounds bounds;
  bool required = true;
};

}  // namespace fsi
