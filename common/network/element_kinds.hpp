#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "base/name_table.hpp"
#include "materials/parameter.hpp"
#include "network/network_element.hpp"

namespace fsi {

/// What the table over time of an element holds, if it has one.
enum class ElementCourse { none, pressure, flow, elastance };

/// An element as the case reader sees it.
struct NetworkElementKind {
  std::vector<Parameter> parameters;
  ElementCourse course;
  /// \param course  of an element with a table: its value at a time in ms
  std::shared_ptr<const NetworkElement> (*make)(const ParameterValues& values,
                                                const std::function<double(double)>& course);
};

/// All elements by name. A new one is a file beside these and a row here; case files, `--help-keys` and all users of
/// networks follow. An element E is a NetworkElement that states
///   E::name          its name in case files
///   E::parameters()  its parameters, see ParameterOf
const NameTable<NetworkElementKind>& network_element_kinds();

}  // namespace fsi
