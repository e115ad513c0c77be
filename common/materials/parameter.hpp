#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/quantity.hpp"

namespace fsi {

/// The parameters of one law by name, as the case file states them. What is absent has its default.
using ParameterValues = std::map<std::string, double>;

/// Sets of parameters of which a layer gives exactly one, as Young's modulus with Poisson's ratio or Lame's constants.
using ParameterSets = std::vector<std::vector<std::string>>;

/// A parameter of a law as users see it: a key of [structure.layers.NAME] for materials, of the law's own section for
/// viscosities, openings and network elements.
struct Parameter {
  std::string name;
  std::string about;  ///< meaning, without the unit
  const Quantity* quantity;
  Bounds bounds;
  bool required;
  double standard = 0;    ///< default, where it is not required
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
