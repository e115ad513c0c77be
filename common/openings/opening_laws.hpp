#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/name_table.hpp"
#include "materials/parameter.hpp"
#include "openings/opening_law.hpp"

namespace fsi {

/// A law as the case reader sees it.
struct OpeningLawKind {
  const char* about;  ///< empty: its parameters are keys of [[opening]] itself, the first by the law's name
  std::vector<Parameter> parameters;
  std::vector<std::pair<std::string, std::string>> letters;  ///< of textbooks, each with the parameter that it means
  std::shared_ptr<const OpeningLaw> (*make)(const ParameterValues& values);

  bool has_section() const { return *about != '\0'; }
};

/// All laws by name. A new one is a file beside these and a row here; case files, `--help-keys` and all users of laws
/// follow. A law L is an OpeningLaw that states
///   L::name          its name in case files
///   L::parameters()  its parameters, see ParameterOf
///   L::about         in case files: of what its section consists; without it, its parameters are keys of [[opening]]
///   L::letters()     textbooks' letters for parameters; only where there are any
const NameTable<OpeningLawKind>& opening_laws();

/// A law by name with its parameters, as a case file says.
struct OpeningLawData {
  std::string name;  ///< one of opening_laws()
  ParameterValues values;

  std::shared_ptr<const OpeningLaw> make() const { return opening_laws().at(name).make(values); }
};

}  // namespace fsi
